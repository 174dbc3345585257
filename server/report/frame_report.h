// What one frame held and did, as reports tell it.
#pragma once

#include "core/frame_stats.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::report {

//   triangles, draws
//   grid          {size, tile_px, near_m, far_m, automatic, why}: the one in use; null: none
//   light_lists   {lights, clusters, empty, entries, largest, overflowed, redraws, mean, p95,
//                 bytes, capped, dropped, dropped_irradiance, all_lights, why}
//   pairs         {evaluated, contributing}: (light, pixel) pairs; null: not counted
//   peel          {layers, overflow_pixels}: of blended surfaces; null: nothing was peeled
//   plan          a line each: what the frame's variant leaves out, and why
//   memory_bytes  {purpose: bytes} of the device's memory
// And what the steps of the frame tell of themselves (render/frame/step_plan.h: StepRow::stats).
[[nodiscard]] nlohmann::ordered_json frameReport(const FrameStats& stats);

} // namespace froxel::report
