// Points of a scene's surfaces: for lights that hover there, and for what its lights bring there.
#pragma once

#include "core/math.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace froxel::light {

struct LightPlace {
    glm::dvec3 position_world{0}; // m, on a surface
    glm::dvec3 normal_world{0};   // unit, out of it
    bool two_sided = false;       // what comes from behind lights it, too
};

inline constexpr uint32_t kLightPlaces = 8192;

// kLightPlaces of them, evenly by area, where the scene rests; none where it has no surface that
// could carry a light. Surfaces that face down have no lights, as ceilings over lamps have none. Of
// more than kMostTriangles triangles each second, third, ... is looked at. The scene may have
// faults (scene::findFault()), which are passed over. Pure; takes some ms.
[[nodiscard]] std::vector<LightPlace> lightPlaces(const scene::Scene& scene);

// The same of the surfaces that lights light: whichever way they face, but not the unlit ones.
[[nodiscard]] std::vector<LightPlace> litPlaces(const scene::Scene& scene);

inline constexpr uint64_t kMostTriangles = uint64_t{1} << 20U;

} // namespace froxel::light
