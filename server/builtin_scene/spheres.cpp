#include "builtin_scene/spheres.h"

#include "builtin_scene/angles.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <string>

namespace froxel::builtin_scene {
namespace {

constexpr double kSpacing_m = 2.5;

// Waves of 20, and of 150 or more, around it: coarse levels keep the first, fine ones the others.
float radiusAt(float around_rad, float down_rad, uint32_t kind) {
    const auto fine = static_cast<float>(150 + kind);
    return 1 +
           0.05F * std::sin(20 * around_rad + static_cast<float>(kind)) * std::sin(20 * down_rad) +
           0.01F * std::sin(fine * around_rad) * std::sin(150 * down_rad);
}

// `rings` from pole to pole of twice as many quads each; those at the poles are triangles.
scene::Primitive bumpySphere(uint32_t rings, uint32_t kind) {
    scene::Primitive sphere;
    const uint32_t across = 2 * rings;
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        const float down_rad = kPi * static_cast<float>(ring) / static_cast<float>(rings);
        for (uint32_t i = 0; i <= across; ++i) {
            const float around_rad =
                kTwoPi * static_cast<float>(i % across) / static_cast<float>(across);
            const glm::vec3 normal(std::sin(down_rad) * std::cos(around_rad), std::cos(down_rad),
                                   std::sin(down_rad) * std::sin(around_rad));
            sphere.positions.push_back(normal * radiusAt(around_rad, down_rad, kind));
            sphere.normals.push_back(glm::normalize(normal));
            sphere.bounds.add(sphere.positions.back());
        }
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        for (uint32_t i = 0; i < across; ++i) {
            const uint32_t above = ring * (across + 1) + i;
            const uint32_t below = above + across + 1;
            if (ring > 0) {
                sphere.indices.insert(sphere.indices.end(), {above, above + 1, below});
            }
            if (ring + 1 < rings) {
                sphere.indices.insert(sphere.indices.end(), {above + 1, below + 1, below});
            }
        }
    }
    return sphere;
}

} // namespace

scene::Scene makeSpheres(const SphereField& field) {
    scene::Scene scene;
    scene.name = "Spheres";
    scene::Material clay;
    clay.name = "Clay";
    clay.base_color = {0.8F, 0.8F, 0.8F, 1};
    clay.metallic = 0;
    clay.roughness = 0.6F;
    scene.materials.push_back(clay);
    // A sphere has 4 rings^2 - 4 rings triangles.
    const double each = static_cast<double>(field.triangle_count) / kSphereMeshes;
    const auto rings = static_cast<uint32_t>(std::ceil((1 + std::sqrt(1 + each)) / 2));
    for (uint32_t kind = 0; kind < kSphereMeshes; ++kind) {
        scene.meshes.push_back({"sphere_" + std::to_string(kind), {bumpySphere(rings, kind)}});
    }
    const uint32_t count = kSphereMeshes * field.copy_count;
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 at(kSpacing_m * (i % side - 0.5 * (side - 1)), 1,
                            -kSpacing_m * static_cast<double>(i / side));
        scene::Instance instance;
        instance.mesh = i % kSphereMeshes;
        instance.world_from_object = glm::translate(glm::dmat4(1), at);
        scene.instances.push_back(instance);
        for (const double reach : {-1.1, 1.1}) {
            scene.bounds_world.add(at + reach);
        }
    }
    const double far_m = kSpacing_m * side;
    settings::Camera camera =
        settings::lookAt({0, 0.25 * far_m + 2, 0.35 * far_m + 3}, {0, 0, -0.4 * far_m}, {0, 1, 0});
    camera.yfov_rad = glm::radians(60.0);
    scene.cameras.push_back({"Field", camera});
    return scene;
}

} // namespace froxel::builtin_scene
