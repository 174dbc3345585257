#include "net/health.h"

#include "core/text.h"

#include <cmath>

namespace froxel::net {
namespace {

Result<void> stepsWithin(const ServiceStatus& status, Seconds limit, TimePoint now) {
    if (!status.serving || !status.serving->heartbeat || limit.count() <= 0) {
        return {};
    }
    const Seconds step = status.serving->heartbeat->stepTime(now);
    if (step <= limit) {
        return {};
    }
    return Error{ErrorCode::kDevice,
                 "the render thread has spent " + numberText(std::round(step.count() * 10) / 10) +
                     " s on one step; the limit is " + numberText(limit.count()) + " s"};
}

} // namespace

Result<void> hasStarted(const ServiceStatus& status) {
    if (status.serving) {
        return {};
    }
    return Error{ErrorCode::kUnsupported,
                 status.loading.stage + ", " +
                     numberText(std::round(100 * status.loading.fraction)) + " %"};
}

Result<void> isReady(const ServiceStatus& status, TimePoint now) {
    if (status.draining) {
        return Error{ErrorCode::kCapacity, "draining"};
    }
    if (status.lost) {
        return Error{ErrorCode::kDevice, *status.lost};
    }
    if (auto started = hasStarted(status); !started) {
        return started;
    }
    return stepsWithin(status, kUnreadyStep, now);
}

Result<void>
isLive(const ServiceStatus& status, const std::function<bool()>& network_moves, TimePoint now) {
    if (status.lost) {
        return Error{ErrorCode::kDevice, *status.lost};
    }
    // Network threads end with the last viewer, while the process is about to end.
    if (!status.draining && !network_moves()) {
        return Error{ErrorCode::kUnsupported, "the network threads accept no work"};
    }
    return rendersOn(status, now);
}

Result<void> rendersOn(const ServiceStatus& status, TimePoint now) {
    return status.serving ? stepsWithin(status, status.serving->step_limit, now) : Result<void>();
}

} // namespace froxel::net
