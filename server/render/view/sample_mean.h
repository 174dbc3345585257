// The mean of several pictures of one size, in linear light: samples of one picture.
#pragma once

#include "core/pixel_view.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel::render {

// One thread at a time.
class SampleMean {
  public:
    // Of host memory, from the first sample until take().
    [[nodiscard]] static uint64_t memoryBytes(const settings::Size& size) {
        return uint64_t{3} * sizeof(uint32_t) * size.width_px * size.height_px;
    }
    [[nodiscard]] uint64_t memoryBytes() const { return sums_.size() * sizeof(uint32_t); }

    // At most 255; all of the first one's size.
    void add(const PixelView& pixels);
    [[nodiscard]] uint32_t count() const { return count_; }
    // RGBA8, sRGB-encoded, alpha 255, rows one after the other; begins anew. At least one sample.
    [[nodiscard]] std::vector<std::byte> take();

  private:
    std::vector<uint32_t> sums_; // [height][width][3], linear, 65,535 a sample
    uint32_t count_ = 0;
};

} // namespace froxel::render
