#include "reference/transmission.h"

#include "core/lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

// The normal on the eye's side.
glm::dvec3 facingNormal(const Surface& s) {
    return glm::dot(s.normal, s.to_eye) < 0 ? -s.normal : s.normal;
}

// Bits of an index in reverse, as a share of 1.
double radicalInverse(uint32_t bits) {
    double share = 0;
    for (double digit = 0.5; bits != 0; bits >>= 1U, digit /= 2) {
        share += (bits & 1U) != 0 ? digit : 0;
    }
    return share;
}

} // namespace

std::optional<glm::dvec3>
refracted(const glm::dvec3& direction, const glm::dvec3& normal, double eta) {
    const double cosine = -glm::dot(direction, normal);
    const double sine2 = eta * eta * (1 - cosine * cosine);
    if (sine2 > 1) {
        return std::nullopt;
    }
    return eta * direction + (eta * cosine - std::sqrt(1 - sine2)) * normal;
}

glm::dvec3 wayThrough(const Surface& s, const Placement& placement, double index) {
    const glm::dvec3 direction = refracted(-s.to_eye, facingNormal(s), 1 / index).value();
    if (glm::determinant(placement.from_object) == 0) {
        return glm::dvec3(0);
    }
    const double turned = glm::length(glm::inverse(placement.from_object) * direction);
    return direction * (s.transmission.thickness / turned);
}

glm::dvec3 indicesOf(const Transmission& t) {
    const double spread = (t.ior - 1) * 0.025 * t.dispersion;
    return {std::max(t.ior - spread, 1.0), t.ior, t.ior + spread};
}

std::vector<LobeSample> throughLobe(const Surface& s, uint32_t count) {
    const double alpha = std::pow(std::max(s.transmission.roughness, kLeastRoughness), 2);
    const glm::dvec3 normal = facingNormal(s);
    const glm::dvec3 across =
        glm::normalize(std::abs(normal.y) < 0.9 ? glm::cross(normal, glm::dvec3(0, 1, 0))
                                                : glm::cross(normal, glm::dvec3(1, 0, 0)));
    const glm::dvec3 along = glm::cross(normal, across);
    const double n_dot_v = std::max(glm::dot(normal, s.to_eye), 1e-4);
    std::vector<LobeSample> samples;
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        // Half vectors as dense as D n.h.
        const double u = (i + 0.5) / count;
        const double angle = 2 * std::numbers::pi * radicalInverse(i);
        const double cosine2 = (1 - u) / (1 + (alpha * alpha - 1) * u);
        const double sine = std::sqrt(std::max(0.0, 1 - cosine2));
        const glm::dvec3 half = normal * std::sqrt(cosine2) +
                                (across * std::cos(angle) + along * std::sin(angle)) * sine;
        const double v_dot_h = glm::dot(s.to_eye, half);
        const glm::dvec3 mirrored = 2 * v_dot_h * half - s.to_eye;
        const double n_dot_l = glm::dot(normal, mirrored);
        if (n_dot_l <= 0 || v_dot_h <= 0) {
            continue;
        }
        const double weight = lobes::visibility(n_dot_l, n_dot_v, alpha * alpha) * n_dot_l *
                              v_dot_h / std::sqrt(cosine2);
        samples.push_back({mirrored - 2 * n_dot_l * normal, weight});
        sum += weight;
    }
    for (LobeSample& sample : samples) {
        sample.share /= sum;
    }
    return samples;
}

} // namespace froxel::reference
