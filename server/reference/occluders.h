// What stands between a surface and a light, by rays in double.
#pragma once

#include "reference/geometry.h"
#include "reference/material.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::reference {

// The triangles that cast shadows: opaque ones and the uncut part of masked ones (by the texture's
// base level), from both sides; not blended ones, nor those of materials with an emissive factor
// and no emissive texture. Immutable: any number of threads may ask. Keeps references to all it is
// given.
class Occluders {
  public:
    Occluders(const scene::Scene& scene,
              std::span<const Placement> placements,
              const Materials& materials);

    // Whether anything lies strictly between two points, relative to the eye. What is nearer to
    // `from` than a millionth of the way is taken for the surface there.
    [[nodiscard]] bool between(const glm::dvec3& from, const glm::dvec3& to) const;

  private:
    struct Caster {
        uint32_t instance = 0;
        uint32_t primitive = 0;
        uint32_t triangle = 0;
        Triangle placed;
    };
    // A box around casters [first, first + count), or around two children.
    struct Node {
        BoundsD3 box;
        uint32_t first = 0;
        uint32_t count = 0; // 0: inner
        uint32_t right = 0; // of an inner node; the left child comes next
    };

    void add(uint32_t instance, uint32_t primitive);
    void build(uint32_t first, uint32_t count);
    [[nodiscard]] bool blocks(const Caster& caster, const Ray& ray) const;

    const scene::Scene& scene_;
    std::span<const Placement> placements_;
    const Materials& materials_;
    std::vector<Caster> casters_;
    std::vector<Node> nodes_;
};

} // namespace froxel::reference
