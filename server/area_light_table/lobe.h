// The glossy lobes that are fitted: BRDF times cosine, over Fresnel's term.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace froxel::area_light_table {

enum class Lobe : uint8_t { kGgx, kBlinnPhong };

// Directions are unit, +z is the surface's normal.
struct LobeSample {
    double value = 0;   // 0 below the surface
    double density = 0; // of sampleLobe(), 1/sr
};
[[nodiscard]] LobeSample
evaluate(Lobe lobe, const glm::dvec3& to_eye, const glm::dvec3& to_light, double alpha);

// The direction to a light of a microfacet normal drawn as often as the lobe has it; u, v: 0 to 1.
[[nodiscard]] glm::dvec3
sampleLobe(Lobe lobe, const glm::dvec3& to_eye, double alpha, double u, double v);

} // namespace froxel::area_light_table
