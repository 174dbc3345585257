#include "diff/composition.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace froxel::diff {
namespace {

constexpr size_t kPixelBytes = 4;

void expectAlike(const PixelView& left, const PixelView& right) {
    FROXEL_ASSERT(left.width_px == right.width_px && left.height_px == right.height_px &&
                      left.width_px > 0 && left.height_px > 0,
                  "both pictures have one size");
}

// Pixels `begin` to `end` of row `y`.
void copyRow(const PixelView& from, uint32_t y, uint32_t begin, uint32_t end, std::byte* to) {
    std::memcpy(to, from.data + y * from.stride_bytes + kPixelBytes * begin,
                kPixelBytes * (end - begin));
}

} // namespace

std::vector<std::byte> stacked(const PixelView& left, const PixelView& right) {
    expectAlike(left, right);
    const size_t row_bytes = kPixelBytes * left.width_px;
    std::vector<std::byte> both(2 * row_bytes * left.height_px);
    std::byte* to = both.data();
    for (const PixelView* side : {&left, &right}) {
        for (uint32_t y = 0; y < side->height_px; ++y, to += row_bytes) {
            copyRow(*side, y, 0, side->width_px, to);
        }
    }
    return both;
}

std::vector<std::byte> divided(const PixelView& left, const PixelView& right, double split) {
    expectAlike(left, right);
    const uint32_t width = left.width_px;
    const auto middle = static_cast<uint32_t>(
        std::lround(std::clamp(split, 0.0, 1.0) * static_cast<double>(width)));
    const size_t row_bytes = kPixelBytes * width;
    std::vector<std::byte> both(row_bytes * left.height_px);
    for (uint32_t y = 0; y < left.height_px; ++y) {
        std::byte* row = both.data() + y * row_bytes;
        copyRow(left, y, 0, middle, row);
        copyRow(right, y, middle, width, row + kPixelBytes * middle);
        if (middle > 0 && middle < width) {
            std::fill(row + kPixelBytes * (middle - 1), row + kPixelBytes * (middle + 1),
                      std::byte{255});
        }
    }
    return both;
}

} // namespace froxel::diff
