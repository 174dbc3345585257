// Highlights longer in one direction: KHR_materials_anisotropy, in double.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>

namespace froxel::reference {

struct Anisotropy {
    double strength = 0;     // 0: none
    glm::dvec3 direction{0}; // along which they are longer; 0: there is none
};

// The surface's axes, and how rough it is along each.
struct AnisotropyAxes {
    glm::dvec3 tangent; // unit, as the bitangent
    glm::dvec3 bitangent;
    double alpha_t;
    double alpha_b;

    AnisotropyAxes(const Anisotropy& a, const glm::dvec3& normal, double alpha)
        : alpha_t(std::lerp(alpha, 1.0, a.strength * a.strength)), alpha_b(alpha) {
        const glm::dvec3 along = a.direction - normal * glm::dot(normal, a.direction);
        tangent = glm::normalize(along);
        bitangent = glm::cross(normal, tangent);
    }
    // Distribution times visibility, as the extension has them: w in the local axes.
    [[nodiscard]] double
    lobe(const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye) const {
        const auto local = [&](const glm::dvec3& w) {
            return glm::dvec3(glm::dot(tangent, w), glm::dot(bitangent, w), glm::dot(normal, w));
        };
        const glm::dvec3 l = local(to_light);
        const glm::dvec3 v = local(to_eye);
        const glm::dvec3 h = glm::normalize(l + v);
        if (h.z <= 0) {
            return 0;
        }
        const glm::dvec3 f(alpha_b * h.x, alpha_t * h.y, alpha_t * alpha_b * h.z);
        const double w2 = alpha_t * alpha_b / glm::dot(f, f);
        const double distribution = alpha_t * alpha_b * w2 * w2 / std::numbers::pi;
        const glm::dvec3 stretch(alpha_t, alpha_b, 1);
        const double shadowing =
            l.z * glm::length(v * stretch) + std::abs(v.z) * glm::length(l * stretch);
        return distribution * 0.5 / shadowing;
    }
    // The normal of what is around, as the extension bends it.
    [[nodiscard]] glm::dvec3
    bent(const Anisotropy& a, const glm::dvec3& normal, const glm::dvec3& to_eye) const {
        const glm::dvec3 across = glm::cross(glm::cross(bitangent, to_eye), bitangent);
        const double even = std::pow(1 - a.strength * (1 - std::sqrt(alpha_b)), 4);
        const double length = glm::length(across);
        return glm::normalize(glm::mix(length > 0 ? across / length : across, normal, even));
    }
};

} // namespace froxel::reference
