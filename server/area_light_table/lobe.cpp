#include "area_light_table/lobe.h"

#include "core/lobes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::area_light_table {

LobeSample evaluate(Lobe lobe, const glm::dvec3& to_eye, const glm::dvec3& to_light, double alpha) {
    const glm::dvec3 half = glm::normalize(to_eye + to_light);
    const double h_dot_v = glm::dot(half, to_eye);
    if (half.z <= 0 || h_dot_v <= 0) {
        return {};
    }
    const double alpha2 = alpha * alpha;
    if (lobe == Lobe::kGgx) {
        const double d = lobes::distribution(half.z, alpha2);
        const double density = d * half.z / (4 * h_dot_v);
        return {to_light.z > 0 ? d * lobes::visibility(to_light.z, to_eye.z, alpha2) * to_light.z
                               : 0.0,
                density};
    }
    const double s = lobes::shininess(alpha2);
    const double density =
        (s + 2) * 0.5 * std::numbers::inv_pi * std::pow(half.z, s + 1) / (4 * h_dot_v);
    return {to_light.z > 0 ? lobes::blinnPhong(half.z, alpha2) * to_light.z : 0.0, density};
}

glm::dvec3 sampleLobe(Lobe lobe, const glm::dvec3& to_eye, double alpha, double u, double v) {
    const double cosine = lobe == Lobe::kGgx
                              ? std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u))
                              : std::pow(u, 1 / (lobes::shininess(alpha * alpha) + 2));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double phi = 2 * std::numbers::pi * v;
    const glm::dvec3 half(sine * std::cos(phi), sine * std::sin(phi), cosine);
    return half * (2 * glm::dot(half, to_eye)) - to_eye;
}

} // namespace froxel::area_light_table
