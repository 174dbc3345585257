#include "app/serve_end.h"

#include "app/exit_codes.h"
#include "app/last_resort.h"
#include "core/text.h"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <utility>

namespace froxel::app {
namespace {

// How often the render thread is looked at.
constexpr std::chrono::milliseconds kWatchPeriod{500};
// For the frames under way when everybody has gone.
constexpr std::chrono::seconds kLastFrame{3};

[[noreturn]] void endWithoutDevice(ServeRun& run, const char* event, const std::string& why) {
    run.giveUp(why);
    spdlog::error("event={} reason={}", event, logValue(why));
    spdlog::default_logger()->flush(); // other threads may yet log
    std::quick_exit(kExitDeviceLost);
}

void endIfDeviceIsLost(ServeRun& run, LatestSlot<Error>& failure) {
    // A scene that could not be opened while everybody left is nobody's loss.
    if (auto error = run.opened() ? failure.take() : std::nullopt) {
        endWithoutDevice(run, "device_lost", error->message);
    }
}

} // namespace

int serveUntilEnd(std::optional<ServeRun>& run,
                  net::StopSignal& stop,
                  LatestSlot<Error>& failure,
                  std::chrono::milliseconds drain_time) {
    Result<void> moves;
    const int signal = stop.wait(kWatchPeriod, [&] {
        moves = run->rendersOn();
        return moves.has_value();
    });
    endIfDeviceIsLost(*run, failure);
    if (auto error = failure.take()) {
        throw StartupError(std::move(*error));
    }
    if (!moves) {
        endWithoutDevice(*run, "device_stuck", moves.error().message);
    }
    using Whole = std::chrono::duration<double>;
    spdlog::info("event=draining signal={} seconds={}", signal, Whole(drain_time).count());
    const bool all_closed = run->drain(drain_time);
    spdlog::info("event=drained all_closed={}", all_closed);
    endIfDeviceIsLost(*run, failure);
    // A scene that is still being loaded cannot be interrupted, and nobody has anything to lose.
    const LastResort last_resort(run->opened() ? kLastFrame : std::chrono::seconds(0),
                                 EXIT_SUCCESS);
    run->stop();
    endIfDeviceIsLost(*run, failure); // with the frames that were under way
    run.reset();
    return EXIT_SUCCESS;
}

} // namespace froxel::app
