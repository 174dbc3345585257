#include "builtin_scene/spheres.h"
#include "scene/scene_check.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace froxel::builtin_scene {
namespace {

TEST(Spheres, HaveTheTrianglesAndCopiesAskedFor) {
    const auto scene = makeSpheres({.triangle_count = 5'000, .copy_count = 3});
    EXPECT_FALSE(scene::findFault(scene));
    ASSERT_EQ(scene.meshes.size(), kSphereMeshes);
    ASSERT_EQ(scene.instances.size(), 3 * kSphereMeshes);
    size_t triangles = 0;
    for (const scene::Mesh& mesh : scene.meshes) {
        triangles += mesh.primitives[0].indices.size() / 3;
    }
    EXPECT_GE(triangles, 5'000U);
    EXPECT_LT(triangles, 6'000U);
    std::map<uint32_t, int> copies;
    for (const scene::Instance& instance : scene.instances) {
        ++copies[instance.mesh];
        const glm::dvec3 middle(instance.world_from_object[3]);
        for (const glm::vec3& position : scene.meshes[instance.mesh].primitives[0].positions) {
            auto bounds = scene.bounds_world;
            bounds.add(middle + glm::dvec3(position));
            EXPECT_EQ(bounds, scene.bounds_world);
        }
    }
    for (const auto& [mesh, count] : copies) {
        EXPECT_EQ(count, 3) << mesh;
    }
}

TEST(Spheres, AreClosedAndFaceOutwards) {
    const auto scene = makeSpheres({.triangle_count = 1'000});
    const auto& sphere = scene.meshes[0].primitives[0];
    double volume = 0;
    for (size_t i = 0; i < sphere.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = sphere.positions[sphere.indices[i + k]];
        }
        volume += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6;
    }
    EXPECT_NEAR(volume, 4.19, 0.5); // m^3, with the normals' side outside
}

} // namespace
} // namespace froxel::builtin_scene
