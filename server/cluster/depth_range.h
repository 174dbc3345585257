// Which depths are worth cutting into slices.
#pragma once

#include "core/math.h"
#include "light/frame_lights.h"
#include "settings/camera.h"

#include <cstdint>

namespace froxel::cluster {

// Metres along the view direction; 0 < near < far.
struct DepthRange {
    double near_m;
    double far_m;
};

// What lights are looked up for.
enum class Lit : uint8_t {
    kSurfaces, // of the scene
    kMedium,   // that fills space, too: behind the scene, and before it
};

// The grid's range for these lights: far is the farthest depth where a light meets what is lit
// (with a margin for rounding), near the depth below which more slices would not make shorter lists
// on the whole. Every visible point of the scene at or beyond far is unlit; in a medium every
// point, but for lights without a range limit, which there end where the scene does.
[[nodiscard]] DepthRange litDepthRange(const light::FrameLights& lights,
                                       const settings::Camera& camera,
                                       const BoundsD3& scene_bounds_world,
                                       Lit lit = Lit::kSurfaces);

} // namespace froxel::cluster
