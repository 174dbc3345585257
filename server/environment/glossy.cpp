#include "environment/glossy.h"

#include "environment/panorama.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace froxel::environment {

SquarePoint hammersley(uint32_t i, uint32_t count) {
    double reversed = 0;
    double digit = 0.5;
    for (uint32_t left = i; left != 0; left >>= 1U, digit /= 2) {
        reversed += (left & 1U) != 0 ? digit : 0;
    }
    return {(i + 0.5) / count, reversed};
}

glm::dvec3 aboutNormal(const glm::dvec3& normal, const glm::dvec3& direction) {
    const glm::dvec3 other = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(other, normal));
    return tangent * direction.x + glm::cross(normal, tangent) * direction.y + normal * direction.z;
}

glm::dvec3 lobeDirection(const glm::dvec3& normal, const glm::dvec3& mirrored, double roughness) {
    const double alpha = roughness * roughness;
    return glm::normalize(glm::mix(normal, mirrored, (1 - alpha) * (std::sqrt(1 - alpha) + alpha)));
}

glm::dvec3 meanOfLobe(const LinearImage& panorama,
                      const glm::dvec3& normal,
                      double roughness,
                      uint32_t samples) {
    glm::dvec3 sum(0);
    double weights = 0;
    eachReflection(roughness, samples, [&](const glm::dvec3& to_light, double weight, double) {
        sum += radianceFrom(panorama, aboutNormal(normal, to_light)) * weight;
        weights += weight;
    });
    return sum / weights;
}

} // namespace froxel::environment
