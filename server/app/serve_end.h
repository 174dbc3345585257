// From the first viewer until the process ends, and how it ends.
#pragma once

#include "app/serve_run.h"
#include "core/latest_slot.h"
#include "net/stop_signal.h"

#include <chrono>
#include <optional>

namespace froxel::app {

// Waits for a signal, a request, a failure of the render thread (`failure`, which comes with a
// request) or a render thread that stands still. The first two drain, destroy `run` and return 0.
// A device that was lost, be it while draining, or stands still is told to all viewers and in one
// line, and ends the process with kExitDeviceLost: a thread inside a driver cannot be joined, and
// nothing can be freed that a device may still use. Throws StartupError: the scene could not be
// opened.
[[nodiscard]] int serveUntilEnd(std::optional<ServeRun>& run,
                                net::StopSignal& stop,
                                LatestSlot<Error>& failure,
                                std::chrono::milliseconds drain_time);

} // namespace froxel::app
