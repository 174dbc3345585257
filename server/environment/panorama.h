// A panorama: the light from every direction, as a picture in equirectangular projection.
//
// Directions are unit and in the world's axes: right-handed, +Y up. Places are u to the right and v
// down, 0 to 1, with
//     u = 1/2 + atan2(z, x) / 2 pi,   v = acos(y) / pi,
// as three.js (equirectUv) and the Khronos renderer (dirToUV) have it: the middle of the picture is
// +X, a quarter of its width to the right is +Z (the front of a glTF scene), its top row is +Y.
#pragma once

#include "core/linear_image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace froxel::environment {

[[nodiscard]] glm::dvec3 directionAt(const glm::dvec2& place);
[[nodiscard]] glm::dvec2 placeOf(const glm::dvec3& direction);

// Turned about +Y by the right hand's rule: +Z goes towards +X. What an environment that is turned
// by an angle sends from a direction stands in its panorama at the direction turned by the negative
// angle.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& direction, double angle_rad);

// Of one texel of a row, sr: exact, so that all of them together are 4 pi.
[[nodiscard]] double texelSolidAngle(const LinearImage& panorama, uint32_t row);

[[nodiscard]] glm::dvec3 texel(const LinearImage& panorama, uint32_t column, uint32_t row);

// Between the centres of texels, linearly; left and right edge are one, top and bottom row go on.
[[nodiscard]] glm::dvec3 radianceFrom(const LinearImage& panorama, const glm::dvec3& direction);

// Over all directions.
[[nodiscard]] glm::dvec3 meanRadiance(const LinearImage& panorama);

} // namespace froxel::environment
