// Geometry and lights of small scenes that tests put together.
#pragma once

#include "scene/scene.h"
#include "support/quad.h"

namespace froxel::test {

// A sphere about the origin of `rings` x 2 `rings` patches, with its true normals.
[[nodiscard]] scene::Primitive sphere(float radius_m, uint32_t rings, uint32_t material);

// White and rough, no metal: stored in a G-buffer without rounding.
[[nodiscard]] scene::Material chalk();

// A scene by parts. Bounds are those of what is in it.
class SceneMaker {
  public:
    explicit SceneMaker(const scene::Material& material = chalk());

    // Returns the material's index.
    uint32_t add(const scene::Material& material);
    SceneMaker& add(scene::Primitive primitive,
                    const glm::dmat4& world_from_object = glm::dmat4(1));
    SceneMaker& point(const glm::dvec3& position, float range_m, float intensity = 1);
    // Half angles in degrees.
    SceneMaker& spot(const glm::dvec3& position,
                     const glm::dvec3& direction,
                     float range_m,
                     double inner_deg,
                     double outer_deg);
    SceneMaker& sun(const glm::dvec3& direction);

    scene::Scene scene;
};

// Surfaces all around the eye at the origin: the inside of a box of half side `half_m`.
[[nodiscard]] SceneMaker insideOfABox(float half_m);

// A wall that faces the eye at the origin from `distance_m` ahead and fills a view of up to 90
// degrees and 2:1.
[[nodiscard]] SceneMaker wallAhead(float distance_m);

} // namespace froxel::test
