// Node hierarchies, scenes, instancing, cameras and lights.
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::gltf {
namespace {

using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kHalfRoot = 0.70710678118654752;

glm::dvec3 apply(const scene::Instance& instance, const glm::dvec3& point) {
    return glm::dvec3(instance.world_from_object * glm::dvec4(point, 1));
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(actual - expected), 1e-12)
        << actual.x << " " << actual.y << " " << actual.z;
}

TEST(Nodes, Transform_IsTranslationTimesRotationTimesScale) {
    SceneFile file;
    file.json["nodes"][0].update({{"translation", {10, 0, 0}},
                                  {"rotation", {0, 0, kHalfRoot, kHalfRoot}},
                                  {"scale", {2, 3, 4}}});
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].name, "node");
    expectNear(apply(scene.instances[0], {1, 1, 1}), {7, 2, 4});
}

TEST(Nodes, Matrix_IsColumnMajor) {
    SceneFile file;
    file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 5, 6, 7, 1};
    const scene::Scene scene = loaded(file.load());
    expectNear(apply(scene.instances.at(0), {1, 1, 1}), {6, 7, 6});
    EXPECT_LT(glm::determinant(glm::dmat3(scene.instances[0].world_from_object)), 0);
}

TEST(Nodes, Children_AreRelativeToTheirParent) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([
        {"children": [1], "translation": [1e6, 0, 0], "scale": [1, -2, 1]},
        {"mesh": 0, "translation": [0.125, 1, 0]}])");
    const scene::Scene scene = loaded(file.load());
    expectNear(apply(scene.instances.at(0), {0, 1, 0}), {1000000.125, -4, 0});
    expectNear(scene.bounds_world.max, {1000001.125, -2, 0});
    expectNear(scene.bounds_world.min, {1000000.125, -4, 0});
}

TEST(Nodes, SharedMesh_IsReadOnceAndPlacedTwice) {
    SceneFile file;
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 3}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
}

TEST(Nodes, DefaultScene_IsShown) {
    SceneFile file;
    file.json["nodes"].push_back({{"mesh", 0}, {"name", "second"}});
    file.json["scenes"].push_back({{"nodes", {1}}});
    file.json["scene"] = 1;
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].name, "second");
}

TEST(Nodes, WithoutDefault_SceneZeroIsShown) {
    SceneFile file;
    file.json["scenes"].push_back({{"nodes", Json::array()}});
    file.json.erase("scene");
    EXPECT_EQ(loaded(file.load()).instances.size(), 1U);
}

TEST(Nodes, WithoutScenes_AllRootsAreShown) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"mesh": 0}, {"mesh": 0}])");
    file.json.erase("scene");
    file.json.erase("scenes");
    EXPECT_EQ(loaded(file.load()).instances.size(), 3U);
}

TEST(Nodes, ChainOfAHundredThousand_IsWalked) {
    constexpr int kCount = 100'000;
    SceneFile file;
    file.json["nodes"] = Json::array();
    for (int i = 0; i + 1 < kCount; ++i) {
        file.json["nodes"].push_back({{"children", {i + 1}}, {"translation", {0, 1, 0}}});
    }
    file.json["nodes"].push_back({{"mesh", 0}});
    const scene::Scene scene = loaded(file.load());
    expectNear(apply(scene.instances.at(0), {0, 0, 0}), {0, kCount - 1, 0});
}

TEST(Nodes, Cycle_IsRefused) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
    EXPECT_THAT(failure(file.load()), HasSubstr("node 1 is part of a cycle"));
}

TEST(Nodes, ChildOfItself_IsRefused) {
    SceneFile file;
    file.json["nodes"][0]["children"] = {0};
    EXPECT_THAT(failure(file.load()), HasSubstr("node 0 is part of a cycle"));
}

// The second parent closes a cycle that placing under the first alone would hide.
TEST(Nodes, CycleBelowASecondParent_IsRefused) {
    SceneFile file;
    file.json["nodes"] =
        Json::parse(R"([{"children": [1]}, {"children": [2]}, {"children": [3, 1]}, {"mesh": 0}])");
    EXPECT_THAT(failure(file.load()), HasSubstr(" is part of a cycle"));
}

TEST(Nodes, ChildOutOfRange_IsRefused) {
    SceneFile file;
    file.json["nodes"][0]["children"] = {7};
    EXPECT_THAT(failure(file.load()), HasSubstr("node 0 uses child node 7; the file has 1"));
}

TEST(Nodes, ProjectiveMatrix_IsMadeAffine) {
    SceneFile file;
    file.json["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.at(0).world_from_object, glm::dmat4(1));
    EXPECT_THAT(scene.warnings.at(0).message, HasSubstr("node 0 has a matrix with the last row"));
}

TEST(Nodes, OverflowingChain_LeavesOutWhatIsBelow) {
    SceneFile file;
    file.json["nodes"] = Json::parse(R"([{"children": [1], "scale": [1e10, 1, 1], "mesh": 0},
                                         {"children": [2], "scale": [1e10, 1, 1], "mesh": 0},
                                         {"mesh": 0}])");
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_THAT(scene.warnings.at(0).message,
                HasSubstr("node 1 has a world matrix with 1e+20 and is left out"));
}

TEST(Instancing, Attributes_PlaceTheMeshManyTimes) {
    SceneFile file;
    file.useExtension("EXT_mesh_gpu_instancing", true);
    const int translation = file.addAccessor<float>({1, 0, 0, 0, 5, 0}, 3);
    const int rotation = file.addAccessor<int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, 4, true);
    const int scale = file.addAccessor<float>({1, 1, 1, 2, 2, 2}, 3);
    file.json["nodes"][0]["translation"] = {0, 0, 9};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}};
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U);
    expectNear(apply(scene.instances[0], {1, 0, 0}), {2, 0, 9});
    expectNear(apply(scene.instances[1], {1, 0, 0}), {-2, 5, 9});
    expectNear(apply(scene.instances[1], {0, 1, 1}), {0, 3, 11}); // a half turn about z
    EXPECT_TRUE(scene.instances[0].node == 0 && scene.instances[1].node == 0);
}

TEST(Instancing, UnequalCounts_AreRefused) {
    SceneFile file;
    const int translation = file.addAccessor<float>({1, 0, 0, 0, 5, 0}, 3);
    const int scale = file.addAccessor<float>({1, 1, 1}, 3);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}, {"SCALE", scale}};
    EXPECT_THAT(failure(file.load()), HasSubstr("instance attributes of 2 and 1 elements"));
}

TEST(Instancing, TooMany_AreRefusedBeforeTheyAreMade) {
    SceneFile file;
    const int translation = file.addAccessorOf(-1, 5126, 2'000'000'000, 3);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}};
    EXPECT_THAT(failure(file.load()), HasSubstr("2000000000 instances"));
}

TEST(Cameras, Perspective_IsPlacedByItsNode) {
    SceneFile file;
    file.json["cameras"] = Json::parse(R"([{"name": "eye", "type": "perspective",
        "perspective": {"yfov": 0.9, "znear": 0.25, "zfar": 10}}])");
    file.json["nodes"][0].update({{"camera", 0},
                                  {"translation", {1, 2, 3}},
                                  {"rotation", {0, kHalfRoot, 0, kHalfRoot}},
                                  {"scale", {2, 2, 2}}});
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    const settings::Camera& camera = scene.cameras[0].camera;
    EXPECT_EQ(camera.projection, settings::Projection::kPerspective);
    EXPECT_EQ(camera.yfov_rad, 0.9);
    EXPECT_EQ(camera.near_m, 0.25);
    expectNear(camera.eye_world, {1, 2, 3});
    expectNear(camera.world_from_view[2], {1, 0, 0});
    expectNear(camera.world_from_view[0], {0, 0, -1});
}

TEST(Cameras, Orthographic_KeepsItsHalfHeight) {
    SceneFile file;
    file.json["cameras"] = Json::parse(R"([{"type": "orthographic",
        "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 10}}])");
    file.json["nodes"][0]["camera"] = 0;
    const settings::Camera camera = loaded(file.load()).cameras.at(0).camera;
    EXPECT_EQ(camera.projection, settings::Projection::kOrthographic);
    EXPECT_EQ(camera.half_height_m, 3);
}

TEST(Cameras, Names_AreFilledInAndUnique) {
    SceneFile file;
    file.json["cameras"] = Json::parse(R"([
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}},
        {"name": "eye", "type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
    file.json["nodes"] = Json::parse(
        R"([{"camera": 0}, {"camera": 0, "name": "north"}, {"camera": 1}, {"camera": 1}])");
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    std::vector<std::string> names;
    for (const scene::NamedCamera& camera : loaded(file.load()).cameras) {
        names.push_back(camera.name);
    }
    EXPECT_THAT(names, ElementsAre("camera0", "north", "eye", "eye-2"));
}

TEST(Cameras, MirroredNode_GivesARightHandedView) {
    SceneFile file;
    file.json["cameras"] =
        Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
    file.json["nodes"][0].update({{"camera", 0}, {"scale", {-1, 1, 1}}});
    const settings::Camera camera = loaded(file.load()).cameras.at(0).camera;
    EXPECT_NEAR(glm::determinant(camera.world_from_view), 1, 1e-12);
}

struct OddCamera {
    const char* camera;
    size_t kept; // 1 or none
    const char* words;
};
class OddCameras : public testing::TestWithParam<OddCamera> {};

TEST_P(OddCameras, IsMadeRightOrLeftOut) {
    SceneFile file;
    file.json["nodes"][0]["camera"] = 0;
    file.json["cameras"] = Json::array({Json::parse(GetParam().camera)});
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.cameras.size(), GetParam().kept);
    EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr(GetParam().words)));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    OddCameras,
    testing::Values(
        OddCamera{R"({"type": "perspective", "perspective": {"yfov": 3.2, "znear": 1}})", 0,
                  "/cameras/0: camera 0 has yfov 3.2 and is left out"},
        OddCamera{R"({"type": "perspective", "perspective": {"znear": 1}})", 0, "has yfov 0"},
        OddCamera{R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}})", 1,
                  "camera 0 has znear 0; 0.01 is used"},
        OddCamera{R"({"type": "perspective", "perspective": {"yfov": 1, "znear": -2}})", 1,
                  "camera 0 has znear -2; 0.01 is used"},
        OddCamera{R"({"type": "orthographic", "orthographic": {"ymag": 0}})", 0, "has ymag 0"},
        OddCamera{R"({"type": "orthographic", "orthographic": {"ymag": -3}})", 1,
                  "has ymag -3; 3 is used"},
        OddCamera{R"({"type": "orthographic", "orthographic": {"ymag": 3, "znear": -1}})", 1,
                  "has znear -1; 0 is used"},
        OddCamera{R"({"type": "orthographic"})", 0, "has ymag 0"},
        OddCamera{R"({"type": "fisheye"})", 0, "camera 0 has the type 'fisheye'"},
        OddCamera{R"({"type": 7})", 0, "camera 0 has the type '7'"},
        OddCamera{"{}", 0, "camera 0 has the type ''"}));

TEST(Cameras, ThatDoesNotExist_IsLeftOut) {
    SceneFile file;
    file.json["nodes"][0]["camera"] = 1;
    EXPECT_THAT(test::told(file.load()),
                HasSubstr("UNRESOLVED_REFERENCE at /nodes/0/camera: node 0 uses camera 1"));
}

SceneFile lit(const char* light) {
    SceneFile file;
    file.useExtension("KHR_lights_punctual");
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({Json::parse(light)});
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    file.json["nodes"][0]["translation"] = {1, 2, 3};
    return file;
}

TEST(Lights, Point_HasPositionColorAndRange) {
    const scene::Scene scene =
        loaded(lit(R"({"type": "point", "name": "bulb", "color": [1, 0.5, 0], "intensity": 40,
                "range": 6})")
                   .load());
    ASSERT_EQ(scene.lights.size(), 1U);
    const scene::PunctualLight& light = scene.lights[0];
    EXPECT_EQ(light.name, "bulb");
    EXPECT_EQ(light.type, scene::LightType::kPoint);
    EXPECT_EQ(light.color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(light.intensity, 40);
    EXPECT_EQ(light.range_m, 6);
    expectNear(light.position_world, {1, 2, 3});
}

TEST(Lights, Spot_LooksAlongItsNode) {
    SceneFile file = lit(R"({"type": "spot", "spot": {"innerConeAngle": 0.1,
                             "outerConeAngle": 0.2}})");
    file.json["nodes"][0]["rotation"] = {-kHalfRoot, 0, 0, kHalfRoot};
    file.json["nodes"][0]["scale"] = {3, 3, 3};
    const scene::PunctualLight light = loaded(file.load()).lights.at(0);
    EXPECT_EQ(light.type, scene::LightType::kSpot);
    EXPECT_EQ(light.inner_cone_rad, 0.1);
    EXPECT_EQ(light.outer_cone_rad, 0.2);
    EXPECT_EQ(light.range_m, 0);
    expectNear(light.direction_world, {0, -1, 0});
}

TEST(Lights, Directional_IsRead) {
    const scene::PunctualLight light =
        loaded(lit(R"({"type": "directional", "intensity": 3})").load()).lights.at(0);
    EXPECT_EQ(light.type, scene::LightType::kDirectional);
    expectNear(light.direction_world, {0, 0, -1});
    EXPECT_EQ(light.name, "node");
}

// A light that one odd value does not cost; its one warning says `words`.
scene::PunctualLight mended(const char* light, const char* words) {
    const scene::Scene scene = loaded(lit(light).load());
    EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr(words))) << light;
    return scene.lights.at(0);
}

TEST(Lights, OddValues_AreBroughtToTheNearest) {
    EXPECT_EQ(
        mended(R"({"type": "point", "intensity": -1})",
               "/extensions/KHR_lights_punctual/lights/0: light 0 has intensity -1; 0 is used")
            .intensity,
        0);
    EXPECT_EQ(mended(R"({"type": "point", "range": -1})", "light 0 has range -1").range_m, 0);
    EXPECT_EQ(mended(R"({"type": "point", "color": [-1, 1, 1]})", "component -1; 0 is used").color,
              glm::vec3(0, 1, 1));
    EXPECT_EQ(mended(R"({"type": "point", "color": [1, 2]})", "color is an array of 2").color,
              glm::vec3(1));
    const auto wide = mended(R"({"type": "spot", "spot": {"outerConeAngle": 2}})",
                             "light 0 has outerConeAngle 2");
    EXPECT_EQ(wide.outer_cone_rad, glm::half_pi<double>());
    for (const auto& [spot, inner, outer] :
         {std::tuple(R"({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}})",
                     0.5, 0.5),
          std::tuple(R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}})",
                     0.5, 0.5),
          std::tuple(R"({"type": "spot", "spot": {"innerConeAngle": -1, "outerConeAngle": 0.5}})",
                     0.0, 0.5)}) {
        const auto light = mended(spot, "light 0 has innerConeAngle");
        EXPECT_EQ(light.inner_cone_rad, inner);
        EXPECT_EQ(light.outer_cone_rad, outer);
    }
    EXPECT_EQ(loaded(lit(R"({"type": "spot"})").load()).lights.at(0).outer_cone_rad,
              glm::quarter_pi<double>());
}

TEST(Lights, UnknownOrMissing_AreLeftOut) {
    EXPECT_THAT(test::told(lit(R"({"type": "area"})").load()),
                HasSubstr("light 0 has the type 'area' and is left out"));
    EXPECT_THAT(test::told(lit("{}").load()), HasSubstr("light 0 has the type ''"));
    SceneFile file = lit(R"({"type": "point"})");
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 4;
    EXPECT_THAT(test::told(file.load()), HasSubstr("node 0 uses light 4; the file has 1"));
}

// Valid glTF: nothing is seen below, but a point shines on all sides.
TEST(Lights, BelowAScaleOfZero_HaveNoDirection) {
    SceneFile file = lit(R"({"type": "spot", "spot": {}})");
    file.json["nodes"].push_back(file.json["nodes"][0]);
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["nodes"][0] = {{"scale", {0, 0, 0}}, {"children", {1}}};
    file.json["scenes"][0]["nodes"] = {0, 2};
    const scene::Scene spot = loaded(file.load());
    EXPECT_TRUE(spot.lights.empty());
    EXPECT_EQ(spot.instances.size(), 1U);
    EXPECT_THAT(test::warningLines(spot),
                ElementsAre(HasSubstr("light 0 is on a node of scale 0")));
    file.json["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "point"}};
    EXPECT_EQ(loaded(file.load()).lights.size(), 1U);
}

} // namespace
} // namespace froxel::gltf
