#include "environment/albedo.h"

#include "core/lobes.h"
#include "environment/ggx.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace froxel::environment {
namespace {

constexpr double kLast = kAlbedoTableSize - 1;

} // namespace

Albedo albedo(double n_dot_v, double roughness) {
    constexpr int kPolar = 256;
    constexpr int kAround = 128; // half a turn: the lobe is symmetric
    const double alpha = roughness * roughness;
    const glm::dvec3 to_eye(std::sqrt(std::max(0.0, 1 - n_dot_v * n_dot_v)), 0, n_dot_v);
    Albedo sum;
    for (int i = 0; i < kPolar; ++i) {
        // Denser where half vectors lie flat: at grazing angles most light comes from there.
        const double flat = 1 - (i + 0.5) / kPolar;
        for (int k = 0; k < kAround; ++k) {
            const glm::dvec3 half = halfVector({1 - flat * flat, 0.5 * (k + 0.5) / kAround}, alpha);
            const double v_dot_h = glm::dot(to_eye, half);
            const double n_dot_l = 2 * v_dot_h * half.z - n_dot_v;
            if (n_dot_l <= 0) {
                continue;
            }
            const double value = 4 * lobes::visibility(n_dot_l, n_dot_v, alpha * alpha) * n_dot_l *
                                 v_dot_h / half.z * 2 * flat / (kPolar * kAround);
            sum.all += value;
            sum.grazing += value * lobes::fifth(1 - v_dot_h);
        }
    }
    return sum;
}

double reflectedShare(double f0, const Albedo& albedo) {
    const double once = f0 * (albedo.all - albedo.grazing) + albedo.grazing;
    return once * (1 + f0 * (1 / albedo.all - 1));
}

double albedoColumn(double n_dot_v) {
    return kLast * std::cbrt(n_dot_v);
}

double albedoRow(double roughness) {
    const double above = std::max(roughness - kLeastRoughness, 0.0);
    return kLast * std::sqrt(above / (1 - kLeastRoughness));
}

double cosineOfColumn(uint32_t column) {
    const double x = column / kLast;
    return x * x * x;
}

double roughnessOfRow(uint32_t row) {
    const double y = row / kLast;
    return kLeastRoughness + (1 - kLeastRoughness) * y * y;
}

} // namespace froxel::environment
