// Thin films: KHR_materials_iridescence, in double.
#pragma once

#include <glm/vec3.hpp>

namespace froxel::reference {

struct Film {
    double strength = 0; // 0: none
    double ior = 1.3;
    double thickness_nm = 400;
};

// What a surface that reflects `base_f0` head-on reflects under the film, in linear sRGB, 0 to 1:
// the sum of all ways through it (Airy), each brought to a colour by Belcour and Barla's fit of the
// eye's sensitivity (2017), up to the second order. n_dot_v: 0 to 1.
[[nodiscard]] glm::dvec3 filmReflects(const Film& film, const glm::dvec3& base_f0, double n_dot_v);

} // namespace froxel::reference
