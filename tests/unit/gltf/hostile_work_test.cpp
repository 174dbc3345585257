// Small files that ask for much: what is done for each pair of two things of a file, and what a few
// compressed bytes say they hold.
#include "gltf/limits.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <set>
#include <string>

namespace froxel::gltf::test {
namespace {

using ::testing::HasSubstr;

const Json kLens = Json::parse(R"({"type": "perspective", "perspective":
    {"yfov": 1, "znear": 0.1}})");

void addNode(SceneFile& file, const Json& node) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back(node);
}

TEST(HostileWork, ManyCamerasOfOneName_HaveNamesOfTheirOwn_AndAreBounded) {
    SceneFile file;
    file.json["cameras"] = Json::array({kLens});
    for (int i = 0; i < 8000; ++i) {
        addNode(file, {{"name", "view"}, {"camera", 0}});
    }
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.cameras.size(), kMaxChoices);
    std::set<std::string> names;
    for (const scene::NamedCamera& camera : scene.cameras) {
        names.insert(camera.name);
    }
    EXPECT_EQ(names.size(), kMaxChoices);
    EXPECT_EQ(scene.cameras[1].name, "view-2");
    EXPECT_EQ(scene.cameras[1023].name, "view-1024");
    EXPECT_THAT(warningLines(scene).at(0),
                HasSubstr("the file has 8000 cameras; the first 1024 are read"));
}

TEST(HostileWork, NumbersThatNamesHaveAlready_AreLeftOut) {
    SceneFile file;
    file.json["cameras"] = Json::array({kLens});
    for (const char* name : {"a-2", "a", "a", "a-2", "a"}) {
        addNode(file, {{"name", name}, {"camera", 0}});
    }
    const scene::Scene scene = loaded(file.load());
    std::vector<std::string> names;
    for (const scene::NamedCamera& camera : scene.cameras) {
        names.push_back(camera.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"a-2", "a", "a-3", "a-2-2", "a-4"}));
}

// Each of them hangs on the one before, and none has a direction for a while.
TEST(HostileWork, DeepChainOfAnimatedCameras_IsReadInOnePass) {
    constexpr int kDepth = 1000;
    SceneFile file;
    file.json["cameras"] = Json::array({kLens});
    const size_t first = file.json["nodes"].size();
    for (int i = 0; i < kDepth; ++i) {
        Json node = {
            {"camera", 0}, {"scale", {0, 0, 0}}, {"rotation", {0, 0.7071068, 0, 0.7071068}}};
        if (i + 1 < kDepth) {
            node["children"] = {first + static_cast<size_t>(i) + 1};
        }
        file.json["nodes"].push_back(node);
    }
    file.json["scenes"][0]["nodes"].push_back(first);
    const int times = file.addAccessor<float>({0, 1}, 1);
    const int scales = file.addAccessor<float>({0, 0, 0, 1, 1, 1}, 3);
    file.json["animations"] = Json::array(
        {{{"samplers", Json::array({{{"input", times}, {"output", scales}}})},
          {"channels",
           Json::array({{{"sampler", 0}, {"target", {{"node", first}, {"path", "scale"}}}}})}}});
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.cameras.size(), size_t{kDepth});
    // Four quarter turns about y: the fourth camera looks where the file's first would unturned.
    EXPECT_NEAR(scene.cameras[3].camera.world_from_view[2].z, 1, 1e-5);
    EXPECT_NEAR(scene.cameras[0].camera.world_from_view[2].x, 1, 1e-5);
}

TEST(HostileWork, LongNames_AreCutBetweenTwoCharacters) {
    SceneFile file;
    std::string name(kMaxNameBytes - 1, 'n');
    name += "\xC3\xA4nd more";
    file.json["nodes"][0]["name"] = name;
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.at(0).name, std::string(kMaxNameBytes - 1, 'n'));
    EXPECT_THAT(warningLines(scene).at(0),
                HasSubstr("/nodes/0/name has 248 bytes; the first 239 are kept"));
}

TEST(HostileWork, ManyAnimationsAndVariants_AreBounded) {
    SceneFile file;
    file.useExtension("KHR_materials_variants");
    Json& variants = file.json["extensions"]["KHR_materials_variants"]["variants"];
    for (int i = 0; i < 1500; ++i) {
        file.json["animations"].push_back(
            {{"samplers", Json::array()}, {"channels", Json::array()}});
        variants.push_back({{"name", "v" + std::to_string(i)}});
    }
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.material_variants.size(), kMaxChoices);
    const std::string lines = test::told(file.load());
    EXPECT_THAT(lines, HasSubstr("the file has 1500 animations; the first 1024 are read"));
    EXPECT_THAT(lines, HasSubstr("the file has 1500 material variants; the first 1024 are read"));
}

TEST(HostileWork, JointsOfAllSkinnedNodes_AreBounded) {
    SceneFile file;
    file.json["skins"] = Json::array({{{"joints", Json::array()}}});
    for (int i = 0; i < 2000; ++i) {
        file.json["skins"][0]["joints"].push_back(0);
    }
    file.json["nodes"][0]["skin"] = 0;
    for (int i = 0; i < 600; ++i) {
        addNode(file, {{"mesh", 0}, {"skin", 0}});
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("joints of meshes with a skin after"));
}

TEST(HostileWork, MorphWeightsOfAllNodes_AreBounded) {
    SceneFile file;
    for (int i = 0; i < 2000; ++i) {
        file.primitive()["targets"].push_back(Json::object());
    }
    for (int i = 0; i < 600; ++i) {
        addNode(file, {{"mesh", 0}});
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("weights of morph targets after"));
}

TEST(HostileWork, PrimitivesOfAllPlacedMeshes_AreBounded) {
    SceneFile file;
    const Json primitive = file.primitive();
    for (int i = 0; i < 2200; ++i) {
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    for (int i = 0; i < 2000; ++i) {
        addNode(file, {{"mesh", 0}});
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("placed primitives after"));
}

// Each of the nodes has a mesh of its own, since it deforms.
TEST(HostileWork, PrimitivesThatAreRead_AreBounded) {
    SceneFile file;
    file.json["skins"] = Json::array({{{"joints", {0}}}});
    for (int i = 0; i < 1200; ++i) { // points, which are not drawn
        file.json["meshes"][0]["primitives"].push_back(
            {{"mode", 0}, {"attributes", Json::object()}});
        addNode(file, {{"mesh", 0}, {"skin", 0}});
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("primitives after"));
}

// Without normals each corner becomes a vertex.
TEST(HostileWork, CornersOfFlatMeshes_CountAsVertices) {
    SceneFile file;
    file.primitive()["indices"] =
        file.addAccessorOf(-1, componentType<uint32_t>(), kMaxVertices + 2, 1);
    EXPECT_THAT(failure(file.load()), HasSubstr("vertices after 3; a scene may have"));
}

TEST(HostileWork, MeshoptView_ThatItsBytesCannotHold_IsRefused) {
    SceneFile file;
    file.useExtension("EXT_meshopt_compression");
    file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},       {"byteOffset", 0},     {"byteLength", 36},
        {"byteStride", 256}, {"count", 16'000'000}, {"mode", "ATTRIBUTES"}};
    EXPECT_THAT(failure(file.load()), HasSubstr("bufferView 0 says 36 bytes of meshopt data hold "
                                                "4096000000; they can hold at most 36864"));
}

Result<scene::Scene> loadWithin(uint64_t bytes, const std::string& text) {
    const TempFolder folder;
    return load(folder.write("scene.gltf", text), workOn, {bytes, false});
}

TEST(HostileWork, ReadMemory_IsHeldAgainstWhatTheFileSays) {
    constexpr uint64_t kSmall = 8U << 20U;
    SceneFile file;
    file.json["buffers"] = Json::array();
    file.json["bufferViews"] = Json::array();
    file.json["accessors"] = Json::array();
    file.attributes()["POSITION"] = file.addAccessorOf(-1, componentType<float>(), 10'000'000, 3);
    EXPECT_THAT(failure(loadWithin(kSmall, file.json.dump())),
                HasSubstr("mesh 0 primitive 0 needs 611 MiB of memory after 1; there are 8 to read "
                          "a scene with"));
}

TEST(HostileWork, JsonOfManyValues_IsRefusedBeforeItIsKept) {
    std::string text = R"({"asset": {"version": "2.0"}, "nodes": [)";
    for (int i = 0; i < 1'000'000; ++i) {
        text += "[],";
    }
    EXPECT_THAT(failure(loadWithin(64U << 20U, text + "[]]}")),
                HasSubstr("the JSON text needs 1 MiB of memory after 64; there are 64 to read"));
}

TEST(HostileWork, FileThatBecameALink_IsNotFollowed) {
    const TempFolder folder;
    const TempFolder elsewhere;
    const auto there = elsewhere.write("scene.gltf", SceneFile().json.dump());
    const auto path = std::filesystem::canonical(folder.path()) / "scene.gltf";
    std::filesystem::create_symlink(there, path);
    EXPECT_THAT(failure(load(path, workOn, {1U << 30U, true})),
                HasSubstr("which meanwhile became a link"));
}

} // namespace
} // namespace froxel::gltf::test
