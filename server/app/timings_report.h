// The JSON of `froxel render --timings`.
//
//   schema            "froxel.timings.v1"
//   froxel            this build's version
//   device            name, driver, kind ("cpu" or "gpu"), vulkan (API version), subgroup_size
//   host              threads (hardware threads of this machine)
//   scene             as given to --scene
//   settings          every setting of the frames: units are in the names
//   frames            how many were timed; each was collected before the next was submitted
//   warmup_frames     drawn before those, at the first one's time, and not counted
//   time_s, step_s    lights' clock of the first frame; from one frame to the next
//   frame             {gpu_us, host_us, frame_us}: of whole frames. gpu_us: first to last
//   timestamp;
//                     host_us: host work up to submission; frame_us: from submission's call to
//                     readable pixels on the host's clock
//   passes            [{name, frames, gpu_us}]: in the order of first use; frames: how many had it
//   last_frame        frameReport()
//
// Each *_us under frame and passes is {min, median, p95, max} in microseconds.
#pragma once

#include "app/device_summary.h"
#include "core/frame_stats.h"
#include "view/settings.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace froxel::app {

struct TimedRun {
    DeviceSummary device;
    std::string scene;
    view::ViewSettings settings;
    double time_s = 0;
    double step_s = 0;
    uint32_t warmup_count = 0;
    std::vector<FrameStats> frames; // at least one
};

[[nodiscard]] nlohmann::ordered_json timingsReport(const TimedRun& run);

// The field `settings` of it.
[[nodiscard]] nlohmann::ordered_json settingsReport(const view::ViewSettings& settings);

//   triangles, draws
//   grid          {size, tile_px, near_m, far_m, automatic, why}: the one in use; null: none
//   light_lists   {lights, clusters, empty, entries, largest, overflowed, redraws, mean, p95,
//   bytes,
//                 all_lights, why}
//   pairs         {evaluated, contributing}: (light, pixel) pairs; null: not counted
//   peel          {layers, overflow_pixels}: of blended surfaces; null: nothing was peeled
//   plan          a line each: what the frame's variant leaves out, and why
//   memory_bytes  {purpose: bytes} of the device's memory
[[nodiscard]] nlohmann::ordered_json frameReport(const FrameStats& stats);

} // namespace froxel::app
