// Where a frame is seen from.
#pragma once

#include "core/math.h"

namespace froxel::settings {

enum class Projection { kPerspective, kOrthographic };

struct Camera {
    glm::dvec3 eye_world{0, 0, 0};
    glm::dmat3 world_from_view{1}; // columns: right, up, back (the camera looks along -Z)
    Projection projection = Projection::kPerspective;
    double yfov_rad = 0.7853981633974483; // full vertical angle; perspective only
    double half_height_m = 1;             // half the vertical extent; orthographic only
    // Where the picture's middle lies, right and up of the view axis, in half pictures: at {1, 0}
    // the axis meets the left edge. Off-centre frusta for tiled displays and for straight
    // verticals.
    glm::dvec2 lens_shift{0, 0};
    double near_m = 0.05; // distance of the near plane; there is no far plane
    double focus_m = 5;   // distance to what is looked at: where an orbit turns

    [[nodiscard]] glm::dvec3 target_world() const {
        return eye_world - world_from_view[2] * focus_m;
    }
    bool operator==(const Camera&) const = default;
};

// A camera at `eye` looking at `target`; `up` need not be perpendicular. A degenerate up (parallel
// to the view direction) is replaced by an axis that is not; eye == target looks along -Z.
[[nodiscard]] Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

struct Sphere {
    glm::dvec3 center{0};
    double radius_m = 1;
};

// Above the front right.
inline constexpr glm::dvec3 kUsualTowardEye{0.5, 0.35, 1};

// A camera that has all of a sphere in pictures of an aspect, width over height, with a twentieth
// of the distance to spare, from the side that `toward_eye` (of any length) tells; for scenes
// without one.
[[nodiscard]] Camera
overview(const Sphere& sphere_world, double aspect, const glm::dvec3& toward_eye = kUsualTowardEye);

} // namespace froxel::settings
