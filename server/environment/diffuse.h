// What matt surfaces see of an environment: spherical harmonics up to the second order (Ramamoorthi
// and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
#pragma once

#include "core/linear_image.h"

#include <glm/vec3.hpp>

#include <array>

namespace froxel::environment {

// Irradiance over pi, which is the radiance that a white matt surface sends: a constant environment
// of radiance L gives L. With n = (x, y, z), the surface's normal, it is
//     t0 + t1 z + t2 y + t3 x + t4 xz + t5 yz + t6 (3y^2 - 1) + t7 xy + t8 (z^2 - x^2).
struct Diffuse {
    std::array<glm::dvec3, 9> terms{};

    // Never below 0, where a small bright light's terms go on its far side.
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& normal) const;
};

// Every texel counts as constant, and its share of each term is integrated in closed form.
[[nodiscard]] Diffuse diffuseOf(const LinearImage& panorama);

// Of the environment turned by an angle, as turned() in panorama.h has it, and made so many times
// as bright.
[[nodiscard]] Diffuse placed(const Diffuse& diffuse, double angle_rad, double strength);

} // namespace froxel::environment
