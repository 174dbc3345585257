// Glossy reflection of an environment by the split sum (Karis 2013, "Real Shading in Unreal Engine
// 4"): about the mean radiance of a lobe's directions times the lobe's integral. Lobes are GGX with
// height-correlated Smith (core/lobes.h), alpha is the roughness squared. In double: what the
// device does faster is measured by these.
#pragma once

#include "core/linear_image.h"
#include "core/lobes.h"
#include "environment/ggx.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace froxel::environment {

// The i-th of `count` points that cover the unit square evenly (Hammersley), in the square.
[[nodiscard]] SquarePoint hammersley(uint32_t i, uint32_t count);

// From the axes of +Z to those of `normal`; the turn about it is arbitrary.
[[nodiscard]] glm::dvec3 aboutNormal(const glm::dvec3& normal, const glm::dvec3& direction);

// Calls visit(to_light, weight, density) for directions about +Z, where both normal and eye are:
// the mean of radiance by weight is the first factor. The weight is what a direction drawn by its
// half vector has in the lobe, so that the split sum is exact head-on; Karis takes the cosine
// instead. density: of the directions, 1/sr.
template <class Visit>
void eachReflection(double roughness, uint32_t count, const Visit& visit) {
    const double alpha = roughness * roughness;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 half = halfVector(hammersley(i, count), alpha);
        const glm::dvec3 to_light(2 * half.z * half.x, 2 * half.z * half.y,
                                  2 * half.z * half.z - 1);
        if (to_light.z > 0) {
            visit(to_light, to_light.z * lobes::visibility(to_light.z, 1, alpha * alpha),
                  lobes::distribution(half.z, alpha * alpha) / 4);
        }
    }
}

// Where the lobe of a rough surface is about: between the mirrored direction and the normal
// (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 22). The
// first factor is taken there.
[[nodiscard]] glm::dvec3
lobeDirection(const glm::dvec3& normal, const glm::dvec3& mirrored, double roughness);

// The first factor, from the texels themselves.
[[nodiscard]] glm::dvec3 meanOfLobe(const LinearImage& panorama,
                                    const glm::dvec3& normal,
                                    double roughness,
                                    uint32_t samples);

} // namespace froxel::environment
