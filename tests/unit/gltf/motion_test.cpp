// Clips, skins and morph targets of files.
#include "motion/player.h"
#include "scene/motion.h"
#include "support/places.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>

namespace froxel::gltf {
namespace {

using scene::ChannelPath;
using scene::Interpolation;
using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using test::warningLines;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Adds a clip of one channel that moves node 0.
void addClip(SceneFile& file,
             const char* path,
             const std::vector<float>& times,
             const std::vector<float>& values,
             size_t components,
             const char* interpolation = "LINEAR") {
    const int input = file.addAccessor<float>(times, 1);
    const int output = file.addAccessor<float>(values, components);
    file.add(
        "animations",
        {{"name", path},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
}

// The triangle follows nodes 1 and 2, half and half, but corner 0 node 1 alone.
SceneFile skinned() {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([
        {"mesh": 0, "skin": 0, "translation": [0, 0, 50]},
        {"children": [2], "translation": [1, 0, 0]},
        {"translation": [0, 2, 0]}])");
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["skins"] = Json::parse(R"([{"joints": [1, 2]}])");
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    file.attributes()["JOINTS_0"] =
        file.addAccessor<uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 4);
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0}, 4);
    return file;
}

const scene::Deformation& onlyDeformation(const scene::Scene& scene) {
    return scene.motion->deformed.at(0).deformations.at(0);
}

std::vector<glm::dvec3> posedWorld(const scene::Scene& scene, double time_s) {
    const motion::Player player(scene);
    motion::Moment moment;
    player.at(motion::usualClips(player.motion()), time_s, moment);
    motion::PosedVertices vertices;
    player.deformAt(moment, 0, 0, vertices);
    std::vector<glm::dvec3> world;
    for (const glm::vec3& p : vertices.positions) {
        world.emplace_back(moment.instances[0] * glm::dvec4(p, 1));
    }
    return world;
}

TEST(Motion, WithoutAny_IsNull) {
    EXPECT_EQ(loaded(SceneFile().load()).motion, nullptr);
}

TEST(Motion, Clip_IsReadWithItsKeys) {
    SceneFile file;
    addClip(file, "translation", {0.5F, 2}, {1, 2, 3, 4, 5, 6}, 3, "STEP");
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_NE(scene.motion, nullptr);
    const scene::Clip& clip = scene.motion->clips.at(0);
    EXPECT_EQ(clip.name, "translation");
    EXPECT_EQ(clip.duration_s, 2);
    EXPECT_EQ(clip.tracks.at(0).interpolation, Interpolation::kStep);
    EXPECT_THAT(clip.tracks.at(0).times_s, ElementsAre(0.5F, 2));
    EXPECT_THAT(clip.tracks.at(0).values, ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_EQ(clip.channels.at(0).path, ChannelPath::kTranslation);
    EXPECT_EQ(scene.motion->instances.at(0).instance, 0U);
}

// As long as its longest track, whichever comes last.
TEST(Motion, ClipOfTwoTracks_LastsAsLongAsTheLonger) {
    for (const bool longer_first : {true, false}) {
        SceneFile file;
        const int lasting = file.addAccessor<float>({0, 3}, 1);
        const int brief = file.addAccessor<float>({0, 1}, 1);
        const int moves = file.addAccessor<float>({0, 0, 0, 1, 0, 0}, 3);
        const int grows = file.addAccessor<float>({1, 1, 1, 2, 2, 2}, 3);
        file.add("animations",
                 {{"samplers",
                   {{{"input", longer_first ? lasting : brief}, {"output", moves}},
                    {{"input", longer_first ? brief : lasting}, {"output", grows}}}},
                  {"channels",
                   {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                    {{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}}}}});
        const scene::Scene scene = loaded(file.load());
        ASSERT_NE(scene.motion, nullptr);
        EXPECT_EQ(scene.motion->clips.at(0).duration_s, 3) << longer_first;
    }
}

TEST(Motion, NormalizedRotations_AreFloatsBeforeTheyAreMixed) {
    SceneFile file;
    const int input = file.addAccessor<float>({0}, 1);
    const int output = file.addAccessor<int8_t>({0, 0, 127, -128}, 4, true);
    file.add("animations",
             {{"samplers", {{{"input", input}, {"output", output}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}});
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.motion->clips.at(0).tracks.at(0).values, ElementsAre(0, 0, 1, -1));
}

TEST(Motion, OnlyNodesThatMatter_AreKept) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([
        {"children": [1, 2], "translation": [5, 0, 0]}, {"mesh": 0}, {"name": "idle"},
        {"mesh": 0}])");
    file.json["scenes"][0]["nodes"] = {0, 3};
    addClip(file, "translation", {0, 1}, {5, 0, 0, 9, 0, 0}, 3);
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.motion->nodes.size(), 2U);
    EXPECT_EQ(scene.motion->nodes[1].parent, 0U);
    ASSERT_EQ(scene.motion->instances.size(), 1U);
    EXPECT_EQ(scene.motion->instances[0].node, 1U);
    EXPECT_NEAR(scene.bounds_world.max.x, 10, 1e-12); // over the clip; the last stands still
    EXPECT_NEAR(scene.bounds_world.min.x, 0, 1e-12);
}

TEST(Motion, RestPose_IsWhereTheNodesAre) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([
        {"children": [1], "translation": [0.1, 0.2, 0.3], "rotation": [0.1, 0.2, 0.3, 0.4]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0.5, 2, 0, 0, 0, 0, -1, 0, 5, 6, 7, 1]}])");
    addClip(file, "scale", {0, 1}, {1, 1, 1, 2, 2, 2}, 3);
    const scene::Scene scene = loaded(file.load());
    const motion::Player player(scene);
    motion::Moment moment;
    player.at({}, 0, moment);
    EXPECT_EQ(moment.instances.at(0), scene.instances.at(0).world_from_object); // bit for bit
}

TEST(Motion, LightsAndCameras_GoWithTheirNodes) {
    SceneFile file;
    file.useExtension("KHR_lights_punctual");
    file.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::parse(R"([{"type": "point"}])");
    file.json["cameras"] =
        Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
    file.json["nodes"][0]["camera"] = 0;
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, 3);
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.motion->lights.size(), 1U);
    EXPECT_EQ(scene.motion->cameras.size(), 1U);
}

TEST(Motion, Skin_PlacesItsMeshWhereverItsNodeIs) {
    SceneFile file = skinned();
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(onlyDeformation(scene).influences.size(), 5U); // weights of 0 are none
    // Corner 0: joint 1 at (1, 0, 0). Others: half of that and half of (1, 2, 0).
    EXPECT_THAT(posedWorld(scene, 0),
                ElementsAre(glm::dvec3(1, 0, 0), glm::dvec3(2, 1, 0), glm::dvec3(1, 2, 0)));
    file.json["nodes"][0]["translation"] = {7, 7, 7};
    EXPECT_EQ(posedWorld(loaded(file.load()), 0), posedWorld(scene, 0));
    EXPECT_LT(scene.bounds_world.max.z, 1e-3);
}

TEST(Motion, InverseBindMatrices_AreColumnMajor) {
    SceneFile file = skinned();
    const std::vector<float> matrices({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0,  0, 1,
                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -2, 0, 1});
    const int view = file.addView(test::bytesOf(matrices));
    file.json["skins"][0]["inverseBindMatrices"] =
        file.add("accessors",
                 {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
    // Joints at their bind pose leave the mesh where it was made.
    EXPECT_THAT(posedWorld(loaded(file.load()), 0),
                ElementsAre(glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)));
}

TEST(Motion, WeightsOffOne_AreScaled) {
    SceneFile file = skinned();
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({0, 0, 0, 0, 0.5F, 0.25F, 0, 0, 3, 1, 0, 0}, 4);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene),
                ElementsAre(HasSubstr("1 vertices without joint weights"),
                            HasSubstr("2 vertices whose joint weights do not sum to 1")));
    const auto& influences = onlyDeformation(scene).influences;
    ASSERT_EQ(influences.size(), 5U);
    EXPECT_EQ(influences[0].joint, 0U);
    EXPECT_EQ(influences[0].weight, 1);
    EXPECT_FLOAT_EQ(influences[1].weight, 2 / 3.0F);
    EXPECT_EQ(influences[3].weight, 0.75F);
}

// As rounding to 8 or 16 bits leaves them: scaled without a word.
TEST(Motion, WeightsHardlyOffOne_SumToOne) {
    SceneFile file = skinned();
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({1, 0, 0, 0, 0.4995F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0}, 4);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.warnings, IsEmpty());
    const auto& influences = onlyDeformation(scene).influences;
    ASSERT_EQ(influences.size(), 5U);
    EXPECT_FLOAT_EQ(influences[1].weight + influences[2].weight, 1);
    EXPECT_FLOAT_EQ(influences[1].weight, 0.4995F / 0.9995F);
}

TEST(Motion, WeightsThatAreNotFinite_AreNone) {
    SceneFile file = skinned();
    const float infinity = std::numeric_limits<float>::infinity();
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({NAN, 0, 0, 0, infinity, 1, 0, 0, 0.5F, 0.5F, 0, 0}, 4);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene),
                ElementsAre(HasSubstr("ACCESSOR_INVALID_FLOAT at "
                                      "/meshes/0/primitives/0/attributes/WEIGHTS_0: mesh 0 "
                                      "primitive 0 has 2 vertices with joint weights"),
                            HasSubstr("1 vertices without joint weights")));
    const auto& influences = onlyDeformation(scene).influences;
    ASSERT_EQ(influences.size(), 4U);
    EXPECT_EQ(influences[0].joint, 0U);
    EXPECT_EQ(influences[1].joint, 1U);
    EXPECT_EQ(influences[1].weight, 1);
}

TEST(Motion, PositionThatIsNotFinite_LeavesTheOthersToTheirJoints) {
    SceneFile file = skinned();
    file.attributes()["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, NAN, 0, 0}, 3);
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    file.attributes()["JOINTS_0"] = file.addAccessor<uint8_t>(std::vector<uint8_t>(16, 0), 4);
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
    file.primitive()["indices"] = file.addAccessor<uint16_t>({0, 1, 2, 1, 2, 3}, 1);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene), ElementsAre(HasSubstr("the triangles there are not drawn")));
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 3U);
    const std::vector<glm::dvec3> world = posedWorld(scene, 0);
    EXPECT_EQ(world.at(1), glm::dvec3(2, 0, 0));
    EXPECT_TRUE(std::isfinite(world.at(3).x));
}

// KHR_node_visibility hides what a node shows, not what moves others.
TEST(Motion, HiddenJoints_MoveWhatIsSeen) {
    SceneFile file = skinned();
    const std::vector<glm::dvec3> seen = posedWorld(loaded(file.load()), 0);
    file.useExtension("KHR_node_visibility");
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
    EXPECT_EQ(posedWorld(loaded(file.load()), 0), seen);
    file.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    const scene::Scene hidden = loaded(file.load());
    EXPECT_EQ(hidden.motion, nullptr);
    EXPECT_THAT(hidden.instances, IsEmpty());
}

TEST(Motion, AllSetsOfInfluences_Count) {
    SceneFile file = skinned();
    file.attributes()["JOINTS_1"] = file.addAccessor<uint16_t>(std::vector<uint16_t>(12, 1), 4);
    file.attributes()["WEIGHTS_1"] =
        file.addAccessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4, true);
    EXPECT_EQ(onlyDeformation(loaded(file.load())).influences.size(), 5U);
    file.attributes()["WEIGHTS_1"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 4);
    EXPECT_EQ(onlyDeformation(loaded(file.load())).influences.size(), 8U);
}

TEST(Motion, JointOutOfRange_IsRefused) {
    SceneFile file = skinned();
    file.attributes()["JOINTS_0"] =
        file.addAccessor<uint8_t>({0, 0, 0, 0, 0, 9, 0, 0, 0, 1, 0, 0}, 4);
    EXPECT_THAT(failure(file.load()), HasSubstr("vertex 1 uses joint 9; its skin has 2"));
}

TEST(Motion, MeshOfTwoSkins_IsTwoMeshes) {
    SceneFile file = skinned();
    file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"] = {0, 1, 3, 4};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.meshes.size(), 3U);
    EXPECT_EQ(scene.motion->deformed.size(), 2U);
}

TEST(Motion, BrokenSkin_LeavesTheRestPose) {
    const auto warnedOf = [](const char* skin, const char* what) {
        SceneFile file = skinned();
        file.json["skins"][0] = Json::parse(skin);
        const scene::Scene scene = loaded(file.load());
        EXPECT_THAT(warningLines(scene), ElementsAre(HasSubstr(what)));
        EXPECT_EQ(scene.motion, nullptr);
        EXPECT_EQ(scene.instances.at(0).world_from_object[3].z, 50);
    };
    warnedOf(R"({"joints": []})", "skin 0 has no joints");
    warnedOf(R"({})", "skin 0 has no joints");
    warnedOf(R"({"joints": [1, 77]})", "skin 0 has the joint node 77");
    warnedOf(R"({"joints": [1, 2], "inverseBindMatrices": 99})", "skin 0 uses accessor 99");
    warnedOf(R"({"joints": [1, 2], "inverseBindMatrices": 0})", "accessor 0 with 3 components");
    SceneFile file = skinned();
    file.json["nodes"][0]["skin"] = 4;
    EXPECT_THAT(warningLines(loaded(file.load())), ElementsAre(HasSubstr("node 0 uses skin 4")));
}

TEST(Motion, SingularSkin_IsDrawnFlat) {
    SceneFile file = skinned();
    file.json["nodes"][1]["scale"] = {0, 0, 0};
    for (const glm::dvec3& p : posedWorld(loaded(file.load()), 0)) {
        EXPECT_EQ(p, glm::dvec3(1, 0, 0));
    }
}

SceneFile morphed() {
    SceneFile file;
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    const int lifted = file.addAccessor<float>({0, 0, 4, 0, 0, 0, 0, 0, 0}, 3);
    const int spread = file.addAccessor<float>({0, 0, 0, 8, 0, 0, 0, 8, 0}, 3);
    file.primitive()["targets"] = {{{"POSITION", lifted}}, {{"POSITION", spread}}};
    return file;
}

TEST(Motion, Targets_AreKeptByVertexWithoutTheirZeros) {
    SceneFile file = morphed();
    file.json["meshes"][0]["weights"] = {0.5, 0};
    file.json["nodes"][0]["weights"] = {1, 0.25};
    addClip(file, "weights", {0, 1}, {0, 0, -1, 2}, 1);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_THAT(scene.motion->rest_weights, ElementsAre(1, 0.25F)); // the node's win
    EXPECT_THAT(onlyDeformation(scene).first_delta, ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(onlyDeformation(scene).deltas[1].target, 1U);
    EXPECT_EQ(scene.meshes[0].primitives[0].positions[0], glm::vec3(0));
    EXPECT_THAT(posedWorld(scene, 0.5),
                ElementsAre(glm::dvec3(0, 0, -2), glm::dvec3(9, 0, 0), glm::dvec3(0, 9, 0)));
}

TEST(Motion, WeightsThatRest_AreAppliedForGood) {
    SceneFile file = morphed();
    file.json["meshes"][0]["weights"] = {0.5, 0};
    file.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 1}}});
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.motion, nullptr);
    ASSERT_EQ(scene.meshes.size(), 2U); // nodes with the same weights share one
    EXPECT_EQ(scene.meshes[0].primitives[0].positions[0], glm::vec3(0, 0, 2));
    EXPECT_EQ(scene.meshes[1].primitives[0].positions[1], glm::vec3(9, 0, 0));
}

TEST(Motion, MeshWithoutNormals_StaysFlatAsItMoves) {
    SceneFile file = morphed();
    file.attributes().erase("NORMAL");
    file.primitive()["indices"] = file.addAccessor<uint16_t>({2, 0, 1}, 1);
    addClip(file, "weights", {0, 1}, {1, 0, 1, 0}, 1);
    const scene::Scene scene = loaded(file.load());
    EXPECT_TRUE(onlyDeformation(scene).flat_normals);
    const motion::Player player(scene);
    motion::Moment moment;
    player.at(motion::usualClips(player.motion()), 0, moment);
    motion::PosedVertices vertices;
    player.deformAt(moment, 0, 0, vertices);
    EXPECT_EQ(vertices.positions[1], glm::vec3(0, 0, 4));
    const glm::dvec3 right = glm::normalize(glm::dvec3(4, 4, 1)); // of (0,1,0) (0,0,4) (1,0,0)
    EXPECT_LT(glm::length(glm::dvec3(vertices.normals[0]) - right), 1e-6);
}

// What of a clip cannot be played, and what is said.
void expectDropped(SceneFile& file, const char* what) {
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene), ElementsAre(HasSubstr(what)));
    EXPECT_EQ(scene.motion, nullptr) << what;
    EXPECT_EQ(scene.instances.size(), 1U);
}

TEST(Motion, BrokenTracks_KeepTheRestPose) {
    const auto drop = [](const std::vector<float>& times, const std::vector<float>& values,
                         const char* what) {
        SceneFile file;
        addClip(file, "translation", times, values, 3);
        expectDropped(file, what);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    drop({0, nan}, {0, 0, 0, 1, 1, 1}, "a number that is not finite");
    drop({0, 1}, {0, 0, 0, 1, nan, 1}, "a number that is not finite");
    drop({1, 0}, {0, 0, 0, 1, 1, 1}, "keys that go back in time");
    drop({0, 1}, {0, 0, 0}, "3 numbers of output; expected 6");
    drop({}, {}, "no keys");
}

TEST(Motion, BrokenChannels_AreNotPlayed) {
    const auto drop = [](const char* pointer, const Json& value, const char* what) {
        SceneFile file;
        addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, 3);
        file.json["animations"][0][Json::json_pointer(pointer)] = value;
        expectDropped(file, what);
    };
    drop("/channels/0/target/path", "pointer", "has the path 'pointer'");
    drop("/channels/0/target/path", "weights", "a node without morph targets");
    drop("/channels/0/target/path", "rotation", "with 3 components; expected 4");
    drop("/channels/0/target/node", 9, "moves node 9; the file has 1");
    drop("/channels/0/sampler", 5, "uses sampler 5 of 1");
    drop("/samplers/0/interpolation", "SMOOTH", "has the interpolation 'SMOOTH'");
    drop("/samplers/0/input", 44, "animation 0 sampler 0 uses accessor 44");
    SceneFile file;
    addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, 3);
    file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    expectDropped(file, "moves a node that has a matrix");
    file.json["animations"][0]["channels"][0]["target"].erase("node");
    EXPECT_THAT(loaded(file.load()).warnings, IsEmpty()); // the specification has it ignored
}

TEST(Motion, TargetThatIsANumber_MovesNothing) {
    SceneFile file;
    addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, 3);
    file.json["bufferViews"][0]["target"] = 34962; // of buffer views it is one
    EXPECT_NE(loaded(file.load()).motion, nullptr);
    file.json["animations"][0]["channels"][0]["target"] = 0;
    EXPECT_THAT(test::told(file.load()),
                HasSubstr("/animations/0/channels/0/target is a number and has no effect"));
}

TEST(Motion, SecondChannelOfAPath_IsNotPlayed) {
    SceneFile file;
    addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, 3);
    file.json["animations"][0]["channels"].push_back(file.json["animations"][0]["channels"][0]);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(warningLines(scene),
                ElementsAre(HasSubstr("moves the target of an earlier channel")));
    EXPECT_EQ(scene.motion->clips.at(0).channels.size(), 1U);
}

TEST(Motion, TooManyKeys_AreNotRead) {
    SceneFile file;
    addClip(file, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, 3);
    file.json["animations"][0]["samplers"][0]["input"] =
        file.addAccessorOf(-1, 5126, 2'000'000'000, 1);
    expectDropped(file, "needs 2000000006 numbers of animations");
}

TEST(Motion, GrowingFromNothing_IsKept) {
    SceneFile file;
    file.json["nodes"][0]["scale"] = {0, 0, 0};
    addClip(file, "scale", {0, 1}, {0, 0, 0, 2, 2, 2}, 3);
    EXPECT_EQ(loaded(file.load()).motion->instances.size(), 1U);
}

std::filesystem::path model(const char* name) {
    return froxel::test::repositoryPath("../shared/scenes/models") / name;
}

// Not part of the repository.
TEST(Motion, Fox_RunsInItsBounds) {
    const auto path = model("fox/Fox.glb");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no fox at " << path;
    }
    const scene::Scene scene = loaded(load(path));
    ASSERT_NE(scene.motion, nullptr);
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(scene.motion->clips.size(), 3U);
    EXPECT_EQ(scene.motion->clips[1].name, "Walk");
    EXPECT_EQ(scene.motion->skins.at(0).joints.size(), 24U);
    const motion::Player player(scene);
    motion::Moment moment;
    motion::PosedVertices vertices;
    for (uint32_t clip = 0; clip < 3; ++clip) {
        for (double time_s = 0; time_s < 2; time_s += 0.17) {
            const motion::PlayedClip played{.clip = clip, .clock = {}, .fade = {}};
            player.at(std::span(&played, 1), time_s, moment);
            player.deformAt(moment, 0, 0, vertices);
            for (const glm::vec3& p : vertices.positions) {
                const glm::dvec3 world(moment.instances[0] * glm::dvec4(p, 1));
                ASSERT_TRUE(glm::all(glm::lessThanEqual(moment.bounds_world.min, world)) &&
                            glm::all(glm::lessThanEqual(world, moment.bounds_world.max)));
            }
            // Some 160 long and 80 high; boxes of joints are a little more.
            EXPECT_LT(glm::length(moment.bounds_world.size()), 400);
        }
    }
}

TEST(Motion, MorphStressTest_HasEightTargets) {
    const auto path = model("morph-stress-test/morph-stress-test.glb");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no morph stress test at " << path;
    }
    const scene::Scene scene = loaded(load(path));
    ASSERT_NE(scene.motion, nullptr);
    EXPECT_EQ(scene.motion->clips.size(), 3U);
    EXPECT_EQ(scene.motion->rest_weights.size(), 8U);
    EXPECT_EQ(scene.motion->deformed.at(0).deformations.size(), 2U);
}

} // namespace
} // namespace froxel::gltf
