// Whether a scene is looked at from inside, as a room is, or from outside, as a thing is.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace froxel::scene {

// What a ray from a point meets first. Blended surfaces are passed through.
struct RayHit {
    double distance_m = 0;
    bool front = false; // of the surface, as its triangles wind, whether or not the back is drawn
};

// One for each direction (unit, world), where there is any; of one of the instances alone, if
// given. O(directions x triangles whose boxes are met), in double.
[[nodiscard]] std::vector<std::optional<RayHit>>
castRays(const Scene& scene,
         const glm::dvec3& from_world,
         const std::vector<glm::dvec3>& directions_world,
         std::optional<size_t> instance = {});

// One instance around all others, far from them, as a sky dome is: nobody looks at it from outside.
struct Surround {
    size_t instance = 0;
    BoundsD3 rest_world; // of all others
};
[[nodiscard]] std::optional<Surround> surroundOf(const Scene& scene);

// Of 64 rays from the middle of the scene's bounds, evenly spread, most meet fronts, and not close
// by: walls, a floor and perhaps a ceiling; from within a solid thing they meet backs. Nothing that
// one could not stand in is a room, nor is what a sky surrounds. A guess, in which a few engines
// and caves are wrong.
[[nodiscard]] bool isRoom(const Scene& scene);

} // namespace froxel::scene
