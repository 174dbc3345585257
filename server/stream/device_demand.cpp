#include "stream/device_demand.h"

namespace froxel::stream {

void DeviceDemand::onFrame(uint64_t viewer, Seconds cost, double target_hz, TimePoint now) {
    viewers_[viewer] = {cost, target_hz, now};
}

void DeviceDemand::remove(uint64_t viewer) {
    viewers_.erase(viewer);
}

double DeviceDemand::total(TimePoint now) const {
    double wanted = 0;
    uint32_t active = 0;
    uint32_t without_target = 0;
    for (const auto& [viewer, entry] : viewers_) {
        if (now - entry.drawn > kMemory) {
            continue;
        }
        ++active;
        wanted += entry.cost.count() * entry.target_hz;
        without_target += entry.target_hz > 0 ? 0U : 1U;
    }
    return active == 0 ? 0 : wanted + static_cast<double>(without_target) / active;
}

} // namespace froxel::stream
