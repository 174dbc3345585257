// What a stranger's file shows before anybody has set anything.
#include "gltf/gltf_loader.h"
#include "light/arriving_light.h"
#include "scene/enclosing_sphere.h"
#include "scene/first_look.h"
#include "scene/first_view.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/places.h"
#include "support/quad.h"
#include "support/shapes.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>

namespace froxel::test {
namespace {

class FirstLook : public SharedGpuTest {};

constexpr settings::Size kSize{160, 90};

Picture drawAsFirstSeen(gpu::Device& device, const scene::Scene& scene) {
    render::FrameInputs inputs;
    scene::lookFor(scene, light::arrivingLight(scene), inputs.settings);
    inputs.settings.size = kSize;
    inputs.settings.camera =
        scene::firstViewOf(scene, scene::enclosingSphere(scene)).cameraFor(kSize);
    render::Renderer renderer(device, scene);
    return draw(renderer, inputs);
}

int green(const Picture& picture, const glm::uvec2& at) {
    return std::to_integer<int>(picture.rgba8[4 * (size_t{at.y} * picture.width_px + at.x) + 1]);
}

// Where the first view of a scene without cameras has a point.
glm::uvec2 pixelOf(const scene::Scene& scene, const glm::dvec3& point_world) {
    const settings::Camera camera =
        scene::firstViewOf(scene, scene::enclosingSphere(scene)).cameraFor(kSize);
    const glm::dvec3 view =
        glm::transpose(camera.world_from_view) * (point_world - camera.eye_world);
    const double half = -view.z * std::tan(0.5 * camera.yfov_rad);
    return {static_cast<uint32_t>(0.5 * kSize.width_px + view.x / half * 0.5 * kSize.height_px),
            static_cast<uint32_t>(0.5 * kSize.height_px * (1 - view.y / half))};
}

scene::Scene greyCube(float albedo) {
    scene::Material grey;
    grey.base_color = {albedo, albedo, albedo, 1};
    grey.metallic = 0;
    grey.roughness = 1;
    SceneMaker maker(grey);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 out(0);
            glm::vec3 u(0);
            out[axis] = side;
            u[(axis + 1) % 3] = 2;
            const glm::vec3 v = glm::cross(out, u);
            maker.add(quad(out - 0.5F * (u + v), u, v, 1, 0));
        }
    }
    return maker.scene;
}

// Top, front and right, as the studio is made for them; told apart by at least 12 of 255.
TEST_F(FirstLook, GreyCubes_AreToldApartOnEveryFace) {
    const std::array<glm::dvec3, 3> faces = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
    const std::array<std::pair<float, std::array<int, 3>>, 4> expected = {
        {{0.18F, {117, 93, 76}},
         {0.5F, {184, 161, 134}},
         {0.8F, {226, 201, 168}},
         {1.0F, {239, 223, 187}}}};
    std::array<int, 3> darker{};
    for (const auto& [albedo, shown] : expected) {
        SCOPED_TRACE(albedo);
        const scene::Scene cube = greyCube(albedo);
        const Picture picture = drawAsFirstSeen(device(), cube);
        for (size_t face = 0; face < faces.size(); ++face) {
            const int value = green(picture, pixelOf(cube, faces[face]));
            EXPECT_NEAR(value, shown[face], 2) << face;
            EXPECT_GE(value, darker[face] + 12) << face;
            darker[face] = value;
        }
    }
}

// Whatever its light counts as: what is black is shown black, and what is white white.
TEST_F(FirstLook, UnderALightOfItsOwn_ACubeIsAsDarkAsItIs) {
    for (const auto& [albedo, least, most] :
         {std::tuple(0.03F, 10, 60), {0.18F, 85, 125}, {0.8F, 180, 230}}) {
        std::array<int, 3> shown{};
        for (const float lux : {0.001F, 3.0F, 1e5F}) {
            SCOPED_TRACE(lux);
            scene::Scene cube = greyCube(albedo);
            scene::PunctualLight sun;
            sun.type = scene::LightType::kDirectional;
            sun.intensity = lux;
            sun.direction_world = glm::normalize(glm::dvec3(-1, -1.2, -1.5));
            cube.lights.push_back(sun);
            const Picture picture = drawAsFirstSeen(device(), cube);
            const std::array at = {green(picture, pixelOf(cube, {0, 1, 0})),
                                   green(picture, pixelOf(cube, {0, 0, 1})),
                                   green(picture, pixelOf(cube, {1, 0, 0}))};
            EXPECT_GE(at[1], least) << albedo;
            EXPECT_LE(at[1], most) << albedo;
            shown = lux == 0.001F ? at : shown;
            EXPECT_EQ(at, shown) << albedo << ": the unit changes nothing";
        }
    }
}

// What does not show the background, of all pixels.
double coveredShare(const Picture& picture) {
    const auto covered = [&](uint32_t i) {
        const glm::uvec2 at(i % kSize.width_px, i / kSize.width_px);
        return green(picture, at) != green(picture, {0, at.y});
    };
    uint32_t count = 0;
    for (uint32_t i = 0; i < kSize.width_px * kSize.height_px; ++i) {
        count += covered(i) ? 1U : 0U;
    }
    return static_cast<double>(count) / (kSize.width_px * kSize.height_px);
}

// Files of others; not part of the repository, so skipped where they are not there.
class FirstLookOfFiles : public SharedGpuTest {
  protected:
    Picture drawn(const char* file) {
        const auto path = repositoryPath("../shared/scenes/cases/first-look") / file;
        if (!std::filesystem::exists(path)) {
            return {};
        }
        auto scene = gltf::load(path);
        EXPECT_TRUE(scene.has_value()) << scene.error().message;
        return scene ? drawAsFirstSeen(device(), *scene) : Picture();
    }
};

TEST_F(FirstLookOfFiles, ShowSomething_NeitherBlackNorWhite) {
    bool any = false;
    for (const char* file : {"stool.gltf.glb", "khr-materials-emissive-strength-test.gltf",
                             "13_occlusion_strength.gltf", "22_vertex_color.gltf",
                             "LightVisibility.glb", "Events.glb"}) {
        SCOPED_TRACE(file);
        const Picture picture = drawn(file);
        if (picture.rgba8.empty()) {
            continue;
        }
        any = true;
        EXPECT_GT(coveredShare(picture), 0.01);
        uint32_t burnt = 0;
        for (size_t i = 0; i < picture.rgba8.size(); i += 4) {
            burnt += std::to_integer<int>(picture.rgba8[i]) > 250 ? 1U : 0U;
        }
        EXPECT_LT(burnt, picture.rgba8.size() / 4 / 4);
    }
    if (!any) {
        GTEST_SKIP() << "no files of others";
    }
}

TEST_F(FirstLookOfFiles, UnlitQuad_Is124BesideAnyLight) {
    for (const char* file :
         {"unlit_light_0.05.gltf", "unlit_light_1.0.gltf", "unlit_light_50.0.gltf"}) {
        SCOPED_TRACE(file);
        const Picture picture = drawn(file);
        if (picture.rgba8.empty()) {
            GTEST_SKIP() << "no files of others";
        }
        EXPECT_EQ(green(picture, {64, 45}), 124);
        EXPECT_EQ(green(picture, {2, 45}), 63) << "the background";
        EXPECT_NEAR(green(picture, {100, 45}), 175, 5) << "what is lit is as light as it is";
    }
}

} // namespace
} // namespace froxel::test
