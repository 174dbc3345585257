// Which depths are worth cutting into slices.
#pragma once

#include "core/math.h"
#include "light/frame_lights.h"
#include "view/camera.h"

namespace froxel::cluster {

// Metres along the view direction; 0 < near < far.
struct DepthRange {
    double near_m;
    double far_m;
};

// The grid's range for these lights: far is the farthest depth where a light meets the scene (with
// a margin for rounding), near the depth below which more slices would not make shorter lists on
// the whole. Every visible point of the scene at or beyond far is unlit.
[[nodiscard]] DepthRange litDepthRange(const light::FrameLights& lights,
                                       const view::Camera& camera,
                                       const BoundsD3& scene_bounds_world);

} // namespace froxel::cluster
