#include "support/shapes.h"

#include <cmath>
#include <numbers>

namespace froxel::test {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

namespace {

// Different colours, so that no light can stand in for another.
vec3 colorOf(size_t index) {
    const auto part = [&](size_t step) {
        return 0.25F + 0.75F * static_cast<float>(index * step % 11U) / 10.0F;
    };
    return {part(1), part(3), part(7)};
}

} // namespace

scene::Primitive sphere(float radius_m, uint32_t rings, uint32_t material) {
    scene::Primitive p;
    p.material = material;
    for (uint32_t y = 0; y <= rings; ++y) {
        const double polar = std::numbers::pi * (1 - static_cast<double>(y) / rings);
        for (uint32_t x = 0; x <= 2 * rings; ++x) {
            const double turn = std::numbers::pi * x / rings;
            const dvec3 n(std::sin(polar) * std::sin(turn), std::cos(polar),
                          std::sin(polar) * std::cos(turn));
            p.positions.push_back(vec3(n * static_cast<double>(radius_m)));
            p.normals.push_back(vec3(n));
            p.bounds.add(p.positions.back());
        }
    }
    addPatches(p, 2 * rings, rings);
    return p;
}

scene::Material chalk() {
    scene::Material material;
    material.metallic = 0;
    material.roughness = 1;
    return material;
}

SceneMaker::SceneMaker(const scene::Material& material) {
    scene.name = "hard case";
    scene.materials = {material};
}

uint32_t SceneMaker::add(const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

SceneMaker& SceneMaker::add(scene::Primitive primitive, const glm::dmat4& world_from_object) {
    for (const vec3& p : primitive.positions) {
        scene.bounds_world.add(dvec3(world_from_object * glm::dvec4(dvec3(p), 1)));
    }
    scene.instances.push_back({static_cast<uint32_t>(scene.meshes.size()), world_from_object, {}});
    scene.meshes.push_back({"part", {std::move(primitive)}});
    return *this;
}

SceneMaker& SceneMaker::point(const dvec3& position, float range_m, float intensity) {
    scene::PunctualLight light;
    light.position_world = position;
    light.color = colorOf(scene.lights.size());
    light.intensity = intensity;
    light.range_m = range_m;
    scene.lights.push_back(light);
    return *this;
}

SceneMaker& SceneMaker::spot(const dvec3& position,
                             const dvec3& direction,
                             float range_m,
                             double inner_deg,
                             double outer_deg) {
    point(position, range_m);
    auto& light = scene.lights.back();
    light.type = scene::LightType::kSpot;
    light.direction_world = glm::normalize(direction);
    light.inner_cone_rad = glm::radians(inner_deg);
    light.outer_cone_rad = glm::radians(outer_deg);
    return *this;
}

SceneMaker& SceneMaker::sun(const dvec3& direction) {
    point({}, 0);
    scene.lights.back().type = scene::LightType::kDirectional;
    scene.lights.back().direction_world = glm::normalize(direction);
    return *this;
}

SceneMaker insideOfABox(float half_m) {
    SceneMaker maker;
    const float h = half_m;
    const vec3 x(2 * h, 0, 0);
    const vec3 y(0, 2 * h, 0);
    const vec3 z(0, 0, 2 * h);
    maker.add(quad({-h, -h, -h}, x, y, 8, 0)).add(quad({h, -h, h}, -x, y, 8, 0));
    maker.add(quad({h, -h, -h}, z, y, 8, 0)).add(quad({-h, -h, h}, -z, y, 8, 0));
    maker.add(quad({-h, -h, h}, x, -z, 8, 0)).add(quad({-h, h, -h}, x, z, 8, 0));
    return maker;
}

SceneMaker wallAhead(float distance_m) {
    SceneMaker maker;
    const float h = 2.5F * distance_m;
    maker.add(quad({-h, -h, -distance_m}, {2 * h, 0, 0}, {0, 2 * h, 0}, 1, 0));
    return maker;
}

} // namespace froxel::test
