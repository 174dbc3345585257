// Light on its way through a surface that transmits it (KHR_materials_transmission, _volume,
// _dispersion), in double.
#pragma once

#include "reference/brdf.h"
#include "reference/geometry.h"

#include <optional>
#include <vector>

namespace froxel::reference {

// What a ray becomes that meets a surface from the side of its normal; eta: the index of refraction
// before it over that behind. None: it is reflected totally. Unit vectors.
[[nodiscard]] std::optional<glm::dvec3>
refracted(const glm::dvec3& direction, const glm::dvec3& normal, double eta);

// From where the ray enters the body to where it leaves it, as thick as the material says along
// this way: in object space, so that a node's scale counts. index: of refraction.
[[nodiscard]] glm::dvec3
wayThrough(const Surface& surface, const Placement& placement, double index);

// Indices of refraction of red, green and blue.
[[nodiscard]] glm::dvec3 indicesOf(const Transmission& transmission);

// Directions in which a rough surface goes on to see, with their shares, which come to 1: the lobe
// that it would reflect, mirrored to its other side. By Hammersley's points.
struct LobeSample {
    glm::dvec3 direction{0}; // unit
    double share = 0;
};
[[nodiscard]] std::vector<LobeSample> throughLobe(const Surface& surface, uint32_t count);

} // namespace froxel::reference
