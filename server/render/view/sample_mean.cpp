#include "render/view/sample_mean.h"

#include "core/assert.h"

#include <array>
#include <cmath>
#include <limits>

namespace froxel::render {
namespace {

constexpr uint32_t kWhite = std::numeric_limits<uint16_t>::max();

// IEC 61966-2-1.
double linearOf(double srgb) {
    return srgb > 0.04045 ? std::pow((srgb + 0.055) / 1.055, 2.4) : srgb / 12.92;
}

// Apart by 20 and more, so that a mean of equal samples is that sample.
const std::array<uint16_t, 256>& linearTable() {
    static const auto kTable = [] {
        std::array<uint16_t, 256> table{};
        for (size_t i = 0; i < table.size(); ++i) {
            table[i] =
                static_cast<uint16_t>(std::lround(linearOf(static_cast<double>(i) / 255) * kWhite));
        }
        return table;
    }();
    return kTable;
}

// The nearest code of each linear value, by the display's steps.
const std::vector<std::byte>& srgbTable() {
    static const auto kTable = [] {
        std::vector<std::byte> table(size_t{kWhite} + 1);
        uint32_t code = 0;
        for (uint32_t i = 0; i < table.size(); ++i) {
            while (i > linearOf((code + 0.5) / 255) * kWhite) {
                ++code;
            }
            table[i] = static_cast<std::byte>(code);
        }
        return table;
    }();
    return kTable;
}

} // namespace

void SampleMean::add(const PixelView& pixels) {
    const size_t count = size_t{3} * pixels.width_px * pixels.height_px;
    if (count_ == 0) {
        sums_.assign(count, 0);
    }
    FROXEL_ASSERT(sums_.size() == count, "samples of one picture have one size");
    const auto& linear = linearTable();
    uint32_t* sum = sums_.data();
    for (uint32_t y = 0; y < pixels.height_px; ++y) {
        const std::byte* rgba = pixels.data + y * pixels.stride_bytes;
        for (uint32_t x = 0; x < pixels.width_px; ++x, rgba += 4, sum += 3) {
            sum[0] += linear[std::to_integer<size_t>(rgba[0])];
            sum[1] += linear[std::to_integer<size_t>(rgba[1])];
            sum[2] += linear[std::to_integer<size_t>(rgba[2])];
        }
    }
    ++count_;
}

std::vector<std::byte> SampleMean::take() {
    FROXEL_ASSERT(count_ > 0, "a mean needs a sample");
    const std::byte* srgb = srgbTable().data();
    const uint64_t half = count_ / 2;
    const uint64_t inverse = (uint64_t{1} << 32U) / count_ + 1; // right for all such sums
    const auto mean = [&](uint32_t sum) { return srgb[(sum + half) * inverse >> 32U]; };
    std::vector<std::byte> rgba8(sums_.size() / 3 * 4, std::byte{255});
    std::byte* pixel = rgba8.data();
    for (size_t i = 0; i < sums_.size(); i += 3, pixel += 4) {
        pixel[0] = mean(sums_[i]);
        pixel[1] = mean(sums_[i + 1]);
        pixel[2] = mean(sums_[i + 2]);
    }
    *this = {};
    return rgba8;
}

} // namespace froxel::render
