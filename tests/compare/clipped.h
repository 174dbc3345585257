// What of a picture's surfaces says nothing any more.
#pragma once

#include "core/assert.h"
#include "core/pixel_view.h"
#include "image_metrics/pixels.h"
#include "interface/debug_io.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace froxel::test {

struct Clipped {
    uint64_t surface_count = 0; // pixels with a solid surface
    uint64_t black_count = 0;   // of these, with red, green and blue at 0
    uint64_t blown_count = 0;   // of these, with red, green or blue at 255
};

// `depth_view`: the same frame with --debug-view depth, which tells where a solid surface is.
// Pictures of different sizes are a bug of the caller. Any thread.
[[nodiscard]] inline Clipped countClipped(const PixelView& picture, const PixelView& depth_view) {
    image_metrics::expectAlike(picture, depth_view);
    using Bytes = std::array<uint8_t, 3>;
    constexpr Bytes kEmpty = {io::kDebugEmpty & 255U, (io::kDebugEmpty >> 8) & 255U,
                              (io::kDebugEmpty >> 16) & 255U};
    Clipped clipped;
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            if (image_metrics::bytesAt(depth_view, x, y) == kEmpty) {
                continue;
            }
            const Bytes bytes = image_metrics::bytesAt(picture, x, y);
            ++clipped.surface_count;
            clipped.black_count += bytes == Bytes{0, 0, 0} ? 1U : 0U;
            clipped.blown_count += std::ranges::max(bytes) == 255 ? 1U : 0U;
        }
    }
    return clipped;
}

} // namespace froxel::test
