// Viewers at once against one server.
#pragma once

#include "load/stages.h"
#include "load/viewer.h"

#include <functional>
#include <stop_token>

namespace froxel::load {

struct ScriptShare {
    std::string name; // as given; of a file the name alone
    ScriptChoice script;
    uint32_t share = 1; // of the viewers, beside the others' shares
};

struct RunOptions {
    ViewerOptions viewer;
    std::vector<ScriptShare> scripts; // at least one
    std::vector<Visit> visits;        // at least one viewer, in the order in which they join
    // When all viewers have their first frame or have failed, all begin to measure, for `seconds`.
    // Otherwise each measures from its first frame on, and `seconds` count from the start.
    bool measures_together = true;
    Seconds seconds{10};
    uint32_t thread_count = 1;
};

// What the viewers did since the last one, about a second.
struct RunSecond {
    bool measuring = false;            // false: still joining
    Seconds elapsed{0};                // since the run's start
    Seconds length{0};                 // that the changes are of
    uint32_t ended = 0;                // viewers, of all; so for joined
    uint32_t joined = 0;               // have a first frame, or ended without one
    std::vector<ViewerChange> changes; // one for each viewer
};

struct RunResult {
    std::vector<ViewerResult> viewers; // in their order
    double seconds = 0;                // measured; less than asked for when stopped
    bool stopped = false;              // by `stop`
    bool ended_early = false;          // by `each_second`
    double busy_cores = 0;             // of this process, on the whole, over the time measured
};

// Blocks for as long as that takes, ending early on `stop`, when `each_second` says false, or when
// every viewer has failed; calls `each_second` on the calling thread. What goes wrong is in the
// viewers' results.
[[nodiscard]] RunResult runLoad(const RunOptions& options,
                                const std::stop_token& stop,
                                const std::function<bool(const RunSecond&)>& each_second);

// All viewers as one: samples pooled, counts and bytes added up, `seconds` the run's.
[[nodiscard]] ViewerResult pool(const RunResult& result);

} // namespace froxel::load
