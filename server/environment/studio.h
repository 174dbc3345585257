// A neutral studio: what lights a scene that has no lights of its own. Grey soft boxes in a grey
// room, infinitely far away.
#pragma once

#include "core/linear_image.h"

#include <glm/vec3.hpp>

#include <array>

namespace froxel::environment {

// A rectangle that faces the scene, of constant radiance but for its edges, which fade out linearly
// in both directions. Sizes are at distance 1.
struct SoftBox {
    double azimuth_deg;   // of its centre: 0 is +Z, the front, 90 is +X
    double elevation_deg; // 90 is +Y
    double half_width;
    double half_height;
    double edge;     // over which it fades, about half_width and half_height
    double radiance; // beyond the room's
};
// With the room they give a white matt surface that faces up the radiance 1, 0.8 to the front (+Z),
// 0.55 to the right (+X) and 0.4 downwards: what reflects half is told from white on every side
// after the tone map, which cannot tell anything beyond 1.25.
inline constexpr std::array<SoftBox, 4> kSoftBoxes = {{
    {-45, 40, 0.50, 0.50, 0.10, 2.90}, // key
    {55, 15, 0.35, 0.70, 0.10, 1.05},  // fill
    {0, 90, 0.90, 0.60, 0.15, 0.56},   // from above
    {160, 35, 0.30, 0.60, 0.10, 1.20}, // rim
}};
// The room: linear in the direction's height. Its ground is the lighter half, as the floor of a
// studio is.
inline constexpr double kStudioGround = 0.45;
inline constexpr double kStudioCeiling = 0.08;

// The same in all channels: the studio is white by Rec. 709. `direction` is unit.
[[nodiscard]] double studioRadiance(const glm::dvec3& direction);

// [width / 2][width][3]; texels have the radiance of their centres.
[[nodiscard]] LinearImage studioPanorama(uint32_t width_px);

} // namespace froxel::environment
