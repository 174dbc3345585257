// An encoded picture on its way from encode to the socket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace froxel {

// Immutable and shared, so that a slot, a write in flight and a recording hold one copy.
using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

struct EncodedFrame {
    SharedBytes bytes; // one picture, or one frame of video
    bool key = true;   // decodes without any frame before it
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    double wait_us = 0;   // in the encoder's queue
    double encode_us = 0; // in the encoder
    double busy_us = 0;   // that cores worked on it; encode_us where an encoder has threads
};

} // namespace froxel
