// The size of a picture.
#pragma once

#include <cstdint>

namespace froxel {

struct PictureSize {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    bool operator==(const PictureSize&) const = default;

    [[nodiscard]] uint64_t pixelCount() const { return uint64_t{width_px} * height_px; }
};

} // namespace froxel
