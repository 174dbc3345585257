// What stands between a surface and a light, by rays in double.
#pragma once

#include "reference/geometry.h"
#include "reference/material.h"
#include "reference/tree.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::reference {

// The triangles that cast shadows: opaque ones and the uncut part of masked ones (by the texture's
// base level), from both sides; not blended ones, nor those that transmit light, nor those of
// materials with an emissive factor and no emissive texture. Immutable: any number of threads may
// ask. Keeps references to all it is given.
class Occluders {
  public:
    Occluders(const scene::Scene& scene,
              std::span<const Placement> placements,
              const Materials& materials);

    // Whether anything lies strictly between two points, relative to the eye. What is nearer to
    // `from` than a millionth of the way is taken for the surface there.
    [[nodiscard]] bool between(const glm::dvec3& from, const glm::dvec3& to) const;
    // The share of light, as luminance, that passes: none where anything lies between; else what
    // surfaces that transmit light leave of it, each by its strength and colour. One with a body
    // takes the root of that, as there is another side.
    [[nodiscard]] double passes(const glm::dvec3& from, const glm::dvec3& to) const;

  private:
    [[nodiscard]] std::vector<TreeTriangle> casters() const;
    [[nodiscard]] const scene::Primitive& primitiveOf(const TreeTriangle& of) const {
        return scene_.meshes[scene_.instances[of.instance].mesh].primitives[of.primitive];
    }
    [[nodiscard]] SurfacePoint
    pointOf(const TreeTriangle& of, const Ray& ray, const PlanePoint& hit) const;
    [[nodiscard]] bool isCutOut(uint32_t material, const SurfacePoint& point) const;
    [[nodiscard]] double shareOf(const TreeTriangle& surface, const Ray& ray) const;
    [[nodiscard]] bool blocks(const TreeTriangle& caster, const Ray& ray) const;

    const scene::Scene& scene_;
    std::span<const Placement> placements_;
    const Materials& materials_;
    TriangleTree tree_;
    TriangleTree transmissive_;
};

} // namespace froxel::reference
