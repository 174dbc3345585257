// Files of the kinds that exporters write and other loaders stumble over; not part of the
// repository, so skipped where they are not there.
#include "gltf/gltf_loader.h"
#include "scene/scene_check.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <string>

namespace froxel::gltf {
namespace {

using testing::HasSubstr;

struct Case {
    const char* file;
    const char* told; // what a warning must say; "": none but of extensions
    size_t lights = 1;
    size_t cameras = 1;
    size_t images = 0;
};

// That a warning or a remark says so.
bool tells(const scene::Scene& scene, const std::string& text) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const auto& warning) {
        return warning.message.find(text) != std::string::npos;
    });
}

class Cases : public testing::TestWithParam<Case> {};

TEST_P(Cases, IsDrawnByWhatIsGoodInIt) {
    const Case& its = GetParam();
    const auto path = test::repositoryPath("../shared/scenes/cases") / its.file;
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no file at " << path;
    }
    const Result<scene::Scene> scene = load(path);
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    EXPECT_FALSE(scene->instances.empty());
    EXPECT_EQ(scene::findFault(*scene), std::nullopt);
    EXPECT_EQ(scene->lights.size(), its.lights);
    EXPECT_EQ(scene->cameras.size(), its.cameras);
    EXPECT_EQ(scene->images.size(), its.images);
    EXPECT_TRUE(tells(*scene, its.told) || (its.told[0] == '\0' && scene->warnings.empty()))
        << (scene->warnings.empty() ? "no warning" : scene->warnings.front().message);
    for (const scene::Material& material : scene->materials) {
        EXPECT_EQ(material.base_color_texture.texture != scene::kNone, its.images > 0);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Values,
    Cases,
    testing::Values(
        Case{"values/01_spot_equal_cones.gltf", "light 0 has innerConeAngle 0.35"},
        Case{"values/02_spot_inner_above.gltf", "light 0 has innerConeAngle 0.5; 0.35 is used"},
        Case{"values/03_spot_wide.gltf", "light 0 has outerConeAngle 2; 1.57"},
        Case{"values/04_light_color.gltf", "colour component 1.2, which is kept"},
        Case{"values/06_camera_znear0.gltf", "camera 1 has znear 0; 0.01 is used", 1, 2},
        Case{"values/07_reference.gltf", "", 1, 1, 1},
        Case{"values/07_sampler_wrap0.gltf", "sampler 0 has wrapS 0; it repeats", 1, 1, 1},
        Case{"values/10_scale0_animated.gltf", ""},
        Case{"values/10_scale0_camera.gltf", "camera 1 is on a node of scale 0"},
        Case{"values/10_scale0_spot.gltf", "light 0 is on a node of scale 0"},
        Case{"values/10_scale1_to_0.gltf", "", 1, 2},
        Case{"values/21_ymag_negative.gltf", "camera 1 has ymag -2; 2 is used", 1, 2}),
    [](const auto& tested) {
        return std::filesystem::path(tested.param.file).stem().string().substr(3);
    });

INSTANTIATE_TEST_SUITE_P(
    Uris,
    Cases,
    testing::Values(Case{"uris/08_backslash.gltf", "", 1, 1, 1},
                    Case{"uris/08_backslash_bin.gltf", ""},
                    Case{"uris/08_reference.gltf", "", 1, 1, 1},
                    Case{"uris/09_percent_bin.gltf", ""},
                    Case{"uris/09_percent_image.gltf", "", 1, 1, 1}),
    [](const auto& tested) {
        return std::filesystem::path(tested.param.file).stem().string().substr(3);
    });

INSTANTIATE_TEST_SUITE_P(Texcoords,
                         Cases,
                         testing::Values(Case{"texcoord-2-and-3/texcoord_2.gltf", "", 0, 0, 1}),
                         [](const auto& tested) {
                             return std::filesystem::path(tested.param.file).stem().string();
                         });

INSTANTIATE_TEST_SUITE_P(
    Refused,
    Cases,
    testing::Values(Case{"refused/morphLoader.glb", "has the interpolation '0'; expected STEP", 0,
                         0},
                    Case{"refused/meshopt-no-fallback/meshopt-no-fallback.gltf", "", 0, 0}),
    [](const auto& tested) {
        std::string name = std::filesystem::path(tested.param.file).stem().string();
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

TEST(CasesRefused, OldVersion_IsRefusedByItsName) {
    const auto path = test::repositoryPath("../shared/scenes/cases/refused/gltf-1.0.gltf");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no file at " << path;
    }
    const Result<scene::Scene> scene = load(path);
    ASSERT_FALSE(scene.has_value());
    EXPECT_THAT(scene.error().message, HasSubstr("glTF 1.0"));
}

} // namespace
} // namespace froxel::gltf
