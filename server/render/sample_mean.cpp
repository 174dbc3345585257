#include "render/sample_mean.h"

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

double srgbOf(double linear) {
    return linear > 0.0031308 ? 1.055 * std::pow(linear, 1 / 2.4) - 0.055 : 12.92 * linear;
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

const std::vector<std::byte>& srgbTable() {
    static const auto kTable = [] {
        std::vector<std::byte> table;
        for (uint32_t i = 0; i <= kWhite; ++i) {
            table.push_back(
                static_cast<std::byte>(std::lround(srgbOf(static_cast<double>(i) / kWhite) * 255)));
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
    const auto& srgb = srgbTable();
    std::vector<std::byte> rgba8;
    rgba8.reserve(sums_.size() / 3 * 4);
    for (size_t i = 0; i < sums_.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k) {
            rgba8.push_back(srgb[(sums_[i + k] + count_ / 2) / count_]);
        }
        rgba8.push_back(std::byte{255});
    }
    *this = {};
    return rgba8;
}

} // namespace froxel::render
