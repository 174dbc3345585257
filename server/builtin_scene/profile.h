// Moulding profiles and the solids that they sweep: turned, extruded and lofted.
#pragma once

#include "builtin_scene/mesh_builder.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace froxel::builtin_scene {

// A polyline in the plane (outward, up), travelled with the solid on its left hand; corners
// sharper than the crease angle stay hard, others are shaded round.
class Profile {
  public:
    explicit Profile(glm::vec2 start) : points_{start} {}

    Profile& to(glm::vec2 end);
    Profile& by(glm::vec2 offset) { return to(points_.back() + offset); }
    // An arc to start + offset; bulge = sagitta / half chord, positive bulges outward (a torus),
    // negative inward (a scotia).
    Profile& arc(glm::vec2 offset, float bulge, uint32_t steps);

    [[nodiscard]] const std::vector<glm::vec2>& points() const { return points_; }

    struct Point {
        glm::vec2 position;
        glm::vec2 normal;
        float along_m; // distance from the start
    };
    // Unbroken stretches, each smooth inside. `closed` joins the last point to the first (which
    // must be equal).
    [[nodiscard]] std::vector<std::vector<Point>> stretches(bool closed = false) const;

  private:
    std::vector<glm::vec2> points_;
};

// Turns a profile of (radius, height) about the y axis.
void addLathe(MeshBuilder& mesh, const Profile& profile, uint32_t steps);

// Extrudes a profile of (z, y) along x from x0 to x1 in `steps`, without end caps.
void addMoulding(MeshBuilder& mesh, const Profile& profile, float x0, float x1, uint32_t steps = 1);

// Lofts a plan outline (closed, counter-clockwise from above, in (x, -z)) through (scale, height)
// pairs from bottom to top.
void addLoft(MeshBuilder& mesh, const Profile& plan, const std::vector<glm::vec2>& scale_height);

// A round bar of `sides` along a path; the first and last ring stay open, `closed` joins them.
void addTube(MeshBuilder& mesh,
             uint32_t steps,
             uint32_t sides,
             float radius_m,
             bool closed,
             const std::function<glm::vec3(float t)>& path);

} // namespace froxel::builtin_scene
