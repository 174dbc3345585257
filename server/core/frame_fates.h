// What became of pictures on their way from the device to a connection. Counts only grow; any
// thread.
#pragma once

#include <atomic>
#include <cstdint>

namespace froxel {

struct FrameFates {
    std::atomic<uint64_t> rendered{0}; // left the device
    std::atomic<uint64_t> encoded{0};
    std::atomic<uint64_t> samples{0}; // added up to a picture that left with a later one
    // Never reached a connection:
    std::atomic<uint64_t> viewer_gone{0}; // drawn for a viewer that had left
    std::atomic<uint64_t> not_encoded{0}; // the encoder was full or failed
    std::atomic<uint64_t> given_up{0};    // nobody wanted it any more before it was drawn
};

} // namespace froxel
