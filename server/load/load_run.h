// Viewers at once against one server: they join one after another over the ramp; when all of them
// have their first frame or have failed, all begin to measure at the same time.
#pragma once

#include "load/viewer.h"

#include <functional>
#include <stop_token>

namespace froxel::load {

struct RunOptions {
    ViewerOptions viewer;
    uint32_t viewer_count = 1;
    Seconds ramp{0};
    Seconds seconds{10};
    uint32_t thread_count = 1;
};

struct RunProgress {
    bool measuring = false; // false: still joining
    Seconds elapsed{0};     // of joining or measuring
    uint32_t joined = 0;    // viewers that have a first frame, or failed without one
    uint32_t ended = 0;     // viewers that failed
    uint64_t frames = 0;    // since the start, of all viewers
    uint64_t bytes = 0;
};

struct RunResult {
    std::vector<ViewerResult> viewers; // in their order
    double seconds = 0;                // measured; less than asked for when stopped
    bool stopped = false;
};

// Blocks for as long as that takes, ending early on `stop` or when every viewer has failed; calls
// `each_second` on the calling thread. What goes wrong is in the viewers' results.
[[nodiscard]] RunResult runLoad(const RunOptions& options,
                                const std::stop_token& stop,
                                const std::function<void(const RunProgress&)>& each_second);

} // namespace froxel::load
