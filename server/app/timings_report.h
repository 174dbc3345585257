// The JSON of `froxel render --timings`.
//
//   schema            "froxel.timings.v1"
//   froxel            this build's version
//   device            report::DeviceSummary
//   host              threads (hardware threads of this machine)
//   scene             as given to --scene
//   settings          report::settingsReport()
//   frames            how many were timed; each was collected before the next was submitted
//   warmup_frames     drawn before those, at the first one's time, and not counted
//   time_s, step_s    lights' clock of the first frame; from one frame to the next
//   frame             {gpu_us, host_us, frame_us}: of whole frames. gpu_us: from the first to the
//                     last timestamp; host_us: host work up to submission; frame_us: from
//                     submission's call to readable pixels on the host's clock
//   passes            [{name, frames, gpu_us}]: in the order of first use; frames: how many had it
//   last_frame        report::frameReport()
//
// Each *_us under frame and passes is {min, median, p95, max} in microseconds; gpu_us is null where
// the driver wrote no timestamps.
#pragma once

#include "core/frame_stats.h"
#include "report/device_summary.h"
#include "settings/settings.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace froxel::app {

struct TimedRun {
    report::DeviceSummary device;
    std::string scene;
    settings::ViewSettings settings;
    double time_s = 0;
    double step_s = 0;
    uint32_t warmup_count = 0;
    std::vector<FrameStats> frames; // at least one
};

[[nodiscard]] nlohmann::ordered_json timingsReport(const TimedRun& run);

} // namespace froxel::app
