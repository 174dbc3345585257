// The built-in scene through the writer and back.
#include "builtin_scene/hall.h"
#include "gltf_writer/glb_writer.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <memory>

namespace froxel::gltf::test {
namespace {

struct Totals {
    size_t triangles = 0;
    size_t vertices = 0;
    size_t tangents = 0;
};

Totals placedTotals(const scene::Scene& scene) {
    Totals totals;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            totals.triangles += primitive.indices.size() / 3;
            totals.vertices += primitive.positions.size();
            totals.tangents += primitive.tangents.size();
        }
    }
    return totals;
}

class HallRoundTrip : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        hall_ = std::make_unique<scene::Scene>(builtin_scene::makeHall());
        const TempFolder folder;
        const auto path = folder.path() / "hall.glb";
        const Result<void> written = gltf_writer::writeGlb(*hall_, path);
        ASSERT_TRUE(written.has_value()) << written.error().message;
        read_ = std::make_unique<scene::Scene>(loaded(load(path)));
    }
    static void TearDownTestSuite() {
        hall_.reset();
        read_.reset();
    }
    static inline std::unique_ptr<scene::Scene> hall_;
    static inline std::unique_ptr<scene::Scene> read_;
};

TEST_F(HallRoundTrip, Geometry_IsTheSame) {
    EXPECT_THAT(read_->warnings, ::testing::IsEmpty());
    EXPECT_EQ(read_->instances.size(), hall_->instances.size());
    const Totals totals = placedTotals(*read_);
    const Totals before = placedTotals(*hall_);
    EXPECT_EQ(totals.triangles, before.triangles);
    // The hall leaves tangents to the shader; the reader makes them, and parts vertices for them.
    EXPECT_GT(totals.tangents, totals.vertices / 2);
    EXPECT_GE(totals.vertices, before.vertices);
    EXPECT_LT(totals.vertices, before.vertices + before.vertices / 100);
    const glm::dvec3 moved = glm::max(glm::abs(read_->bounds_world.min - hall_->bounds_world.min),
                                      glm::abs(read_->bounds_world.max - hall_->bounds_world.max));
    EXPECT_LT(moved.x + moved.y + moved.z, 1e-3);
}

TEST_F(HallRoundTrip, CamerasAndLights_AreTheSame) {
    ASSERT_EQ(read_->cameras.size(), hall_->cameras.size());
    for (size_t i = 0; i < hall_->cameras.size(); ++i) {
        const settings::Camera& expected = hall_->cameras[i].camera;
        const settings::Camera& camera = read_->cameras[i].camera;
        EXPECT_EQ(read_->cameras[i].name, hall_->cameras[i].name);
        EXPECT_EQ(camera.projection, expected.projection);
        EXPECT_LT(glm::distance(camera.eye_world, expected.eye_world), 1e-6);
        EXPECT_GT(glm::dot(camera.world_from_view[2], expected.world_from_view[2]), 1 - 1e-6);
        EXPECT_NEAR(camera.near_m, expected.near_m, 1e-9);
    }
    ASSERT_EQ(read_->lights.size(), hall_->lights.size());
    for (size_t i = 0; i < hall_->lights.size(); ++i) {
        EXPECT_EQ(read_->lights[i].type, hall_->lights[i].type);
        EXPECT_EQ(read_->lights[i].color, hall_->lights[i].color);
        EXPECT_LT(glm::distance(read_->lights[i].position_world, hall_->lights[i].position_world),
                  1e-6);
    }
}

TEST_F(HallRoundTrip, MaterialsAndPixels_AreTheSame) {
    const auto find = [](const scene::Scene& scene, const std::string& name) {
        return std::find_if(scene.materials.begin(), scene.materials.end(),
                            [&](const scene::Material& material) { return material.name == name; });
    };
    for (const scene::Material& material : read_->materials) {
        const auto expected = find(*hall_, material.name);
        ASSERT_NE(expected, hall_->materials.end()) << material.name;
        EXPECT_EQ(material.base_color, expected->base_color) << material.name;
        EXPECT_EQ(material.roughness, expected->roughness) << material.name;
        EXPECT_EQ(material.alpha_mode, expected->alpha_mode) << material.name;
        EXPECT_EQ(material.double_sided, expected->double_sided) << material.name;
        const uint32_t texture = material.base_color_texture.texture;
        const uint32_t expected_texture = expected->base_color_texture.texture;
        ASSERT_EQ(texture == scene::kNone, expected_texture == scene::kNone) << material.name;
        if (texture != scene::kNone) {
            EXPECT_TRUE(read_->images[read_->textures[texture].image].rgba8 ==
                        hall_->images[hall_->textures[expected_texture].image].rgba8)
                << material.name;
        }
    }
}

} // namespace
} // namespace froxel::gltf::test
