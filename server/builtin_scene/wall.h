// Walls with openings, the frames of those openings, and rings of voussoirs.
#pragma once

#include "builtin_scene/mesh_builder.h"
#include "builtin_scene/profile.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace froxel::builtin_scene {

using Curve = std::function<float(float x)>;
[[nodiscard]] Curve level(float y);

// A hole in a wall, between two curves over the span of `cuts` (ascending).
struct Opening {
    std::vector<float> cuts;
    Curve low;
    Curve high;
    // The outline clockwise as seen from the front, so that the wall lies on its left; open at the
    // bottom where the hole goes down to the wall's foot.
    Profile outline{glm::vec2(0)};
};

// A semicircular arch on jambs that start at `sill`.
[[nodiscard]] Opening archOpening(
    float centre_x, float radius, float sill, float spring, uint32_t steps, bool open_foot = false);
[[nodiscard]] Opening roundOpening(float centre_x, float centre_y, float radius, uint32_t steps);

// A wall in the plane z = 0 that faces +z, from x0 to x1 between two curves. `cuts` are further x
// where the curves bend.
void addWall(MeshBuilder& mesh,
             float x0,
             float x1,
             const Curve& bottom,
             const Curve& top,
             const std::vector<Opening>& openings,
             const std::vector<float>& cuts = {});

// The thickness of the wall inside an opening, from z = -depth to 0.
void addReveal(MeshBuilder& mesh, const Opening& opening, float depth_m);

struct Ring {
    float radius = 1;        // of the intrados
    float height = 0.4F;     // of a voussoir, along the radius
    float half_depth = 0.3F; // along z
    uint32_t count = 15;     // odd: the middle one is the keystone
    float bevel = 0.012F;
    bool keystone = true; // stands proud
    uint32_t omit = 0;    // BoxFace bits: +y is the extrados, -z the back
};
// Voussoirs about the origin in the plane z = 0, opening downward.
void addRing(MeshBuilder& mesh, const Ring& ring);

} // namespace froxel::builtin_scene
