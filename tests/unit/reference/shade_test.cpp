// Whole pictures of the reference against closed forms.
#include "reference/shade.h"
#include "settings/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

// A quad from (-s, y, s) to (s, y, -s), facing up.
scene::Primitive quad(float s, float y, uint32_t material) {
    scene::Primitive p;
    p.positions = {{-s, y, s}, {s, y, s}, {s, y, -s}, {-s, y, -s}};
    p.normals.assign(4, {0, 1, 0});
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

struct Setting {
    scene::Scene scene;
    settings::ViewSettings view;
    Visibility visibility;

    [[nodiscard]] glm::dvec3 pixel(uint32_t x, uint32_t y) const {
        const auto image = shade(scene, view, 0, visibility);
        EXPECT_TRUE(image) << image.error().message;
        const float* rgb = &image->rgb[3 * (size_t{y} * view.size.width_px + x)];
        return {rgb[0], rgb[1], rgb[2]};
    }
};

// A floor seen from 5 m straight above, all pixels its first or second triangle.
Setting floorFromAbove() {
    Setting s;
    s.scene.materials = {{}};
    s.scene.materials[0].metallic = 0;
    s.scene.meshes = {{"floor", {quad(100, 0, 0)}}};
    s.scene.instances = {{}};
    s.view.camera = settings::lookAt({0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    s.view.size = {16, 16};
    s.view.shading = settings::ShadingModel::kLambert;
    s.view.lights.count = 0;
    s.view.lights.ambient = 0;
    s.visibility = {16, 16, {}, {}};
    for (uint32_t i = 0; i < 256; ++i) {
        const uint32_t x = i % 16;
        const uint32_t y = i / 16;
        s.visibility.pixels.push_back({0, 0, x + y >= 15 ? 0U : 1U});
    }
    return s;
}

double half(const Setting& s) {
    return 5 * std::tan(s.view.camera.yfov_rad / 2);
}

TEST(ReferenceShade, FloorUnderOneLight_IsLambertsLaw) {
    Setting s = floorFromAbove();
    scene::PunctualLight light;
    light.position_world = {1, 2, -0.5};
    light.intensity = 3;
    s.scene.lights = {light};
    // Pixel (x, y) looks at half (-1 + (2 x + 1) / 16) to the right, likewise down to +z.
    for (const auto& [x, y] : {std::pair(8U, 8U), std::pair(15U, 3U), std::pair(0U, 12U)}) {
        const glm::dvec3 point(half(s) * ((2 * x + 1) / 16.0 - 1), 0,
                               half(s) * ((2 * y + 1) / 16.0 - 1));
        const glm::dvec3 to_light = light.position_world - point;
        const double expected = 3 * 2 / std::pow(glm::length(to_light), 3) / std::numbers::pi;
        EXPECT_NEAR(s.pixel(x, y).x, expected, 1e-6 * expected);
    }
}

TEST(ReferenceShade, EverythingAThousandKilometresAway_IsTheSamePicture) {
    Setting near = floorFromAbove();
    scene::PunctualLight light;
    light.position_world = {1, 2, -0.5};
    near.scene.lights = {light};
    near.view.shading = settings::ShadingModel::kPbr;
    Setting far = near;
    const glm::dvec3 offset(1e6, -1e6, 1e6);
    far.view.camera.eye_world += offset;
    far.scene.lights[0].position_world += offset;
    far.scene.instances[0].world_from_object[3] += glm::dvec4(offset, 0);
    EXPECT_NEAR(far.pixel(3, 9).x, near.pixel(3, 9).x, 1e-7);
}

TEST(ReferenceShade, AmbientAlone_IsTheSkyOnAFloorAndTheGroundBelow) {
    Setting s = floorFromAbove();
    s.view.lights.ambient = 2;
    s.scene.materials[0].base_color = {0.5F, 0.5F, 0.5F, 1};
    EXPECT_NEAR(s.pixel(4, 4).z, static_cast<double>(settings::kAmbientSky.z), 1e-8);
    s.scene.materials[0].double_sided = true;
    s.scene.instances[0].world_from_object[1][1] = -1; // mirrored: its front looks down
    EXPECT_NEAR(s.pixel(4, 4).z, static_cast<double>(settings::kAmbientSky.z), 1e-8);
}

TEST(ReferenceShade, EmptyPixels_SendNothing) {
    Setting s = floorFromAbove();
    s.visibility.pixels[0].instance = VisibleTriangle::kNothing;
    EXPECT_NEAR(s.pixel(0, 0).z, 0, 1e-9);
}

// Two panes over an emissive floor: a1 c1 + (1 - a1) (a2 c2 + (1 - a2) c0), the higher one first.
TEST(ReferenceShade, BlendedPanes_AreComposedByDepth) {
    Setting s = floorFromAbove();
    s.scene.materials[0].base_color = {0, 0, 0, 1};
    s.scene.materials[0].emissive = {1, 1, 1};
    for (const auto& [value, alpha] : {std::pair(0.5F, 0.25F), std::pair(0.125F, 0.5F)}) {
        scene::Material pane;
        pane.unlit = true;
        pane.base_color = {value, value, value, alpha};
        pane.alpha_mode = scene::AlphaMode::kBlend;
        s.scene.materials.push_back(pane);
    }
    s.scene.meshes.push_back({"panes", {quad(50, 2, 1), quad(50, 1, 2)}});
    s.scene.instances.push_back({.mesh = 1, .world_from_object = glm::dmat4(1), .name = {}});
    const double expected = 0.25 * 0.5 + 0.75 * (0.5 * 0.125 + 0.5 * 1);
    for (uint32_t i = 0; i < 16; ++i) { // the diagonal is an edge that two triangles share
        EXPECT_NEAR(s.pixel(i, 15 - i).x, expected, 1e-6) << i;
        EXPECT_NEAR(s.pixel(i, i).x, expected, 1e-6) << i;
    }
}

TEST(ReferenceShade, WrongVisibility_IsToldInOneLine) {
    Setting s = floorFromAbove();
    s.visibility.pixels[7].triangle = 2;
    auto refused = shade(s.scene, s.view, 0, s.visibility);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("triangle 2 of primitive 0 of instance 0"),
              std::string::npos);
    s.visibility.width_px = 15;
    refused = shade(s.scene, s.view, 0, s.visibility);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("15x16"), std::string::npos);
}

} // namespace
} // namespace froxel::reference
