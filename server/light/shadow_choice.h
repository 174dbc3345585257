// Which lights have shadow maps: those that matter most to a view.
#pragma once

#include "light/frame_lights.h"
#include "settings/camera.h"
#include "settings/settings.h"

#include <cstdint>
#include <vector>

namespace froxel::light {

// What a light of `luminance`, `distance_m` from the eye and reaching `reach_m`, brings to a
// picture, but for a constant: the mean irradiance in its ball, 3 I / r^2, times the ball's share
// of the picture, r^2 / D^2 and the whole picture inside it. So I / max(D, r)^2; times the share of
// all directions that a spot shines in.
[[nodiscard]] double importance(double luminance, double distance_m, double reach_m, double share);

// Indices into `lights.lights`, ascending, of at most `count` lights: the most important ones, of
// equal ones the first. A light that is black, or whose ball does not meet what the camera sees,
// has none; of a camera with a lens shift, which draws a tile of a larger picture, all that lies
// ahead of the eye counts as seen. Lights without a range reach `farthest_m`. A pure function,
// without memory of earlier frames: as the camera moves, a light may lose its maps to another.
[[nodiscard]] std::vector<uint32_t> chooseShadowed(const FrameLights& lights,
                                                   const settings::Camera& camera,
                                                   const settings::Size& size,
                                                   double farthest_m,
                                                   uint32_t count);

} // namespace froxel::light
