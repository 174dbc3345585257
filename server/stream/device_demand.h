// What moving viewers ask of the device together, at the rates they are to keep. Pure: no threads,
// no clock of its own.
#pragma once

#include "core/clock.h"

#include <cstdint>
#include <map>

namespace froxel::stream {

class DeviceDemand {
  public:
    // A viewer that drew nothing for so long rests.
    static constexpr Seconds kMemory{1};

    // A frame of a moving view took this much of the device. target_hz: frames a second that the
    // view is to keep; 0: none, as many as there is time for.
    void onFrame(uint64_t viewer, Seconds cost, double target_hz, TimePoint now);
    void remove(uint64_t viewer);

    // Of the device's time, 1 being all of it: above, the targets cannot all be kept. A viewer
    // without a target counts with its fair share.
    [[nodiscard]] double total(TimePoint now) const;

  private:
    struct Entry {
        Seconds cost{}; // of the last frame
        double target_hz = 0;
        TimePoint drawn{};
    };
    std::map<uint64_t, Entry> viewers_;
};

} // namespace froxel::stream
