#include "bench/picture_scale.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace froxel::bench {

namespace {

// Two neighbours along one axis and the second's share.
struct Tap {
    uint32_t low = 0;
    uint32_t high = 0;
    double share = 0;
};

std::vector<Tap> tapsOf(uint32_t from, uint32_t to) {
    std::vector<Tap> taps(to);
    for (uint32_t i = 0; i < to; ++i) {
        const double at = std::clamp((i + 0.5) * from / to - 0.5, 0.0, from - 1.0);
        const auto low = static_cast<uint32_t>(at);
        taps[i] = {low, std::min(low + 1, from - 1), at - low};
    }
    return taps;
}

// `get(pixel, channel)` reads the old picture as a double; `put(value)` takes the new one's values
// in order.
template <class Get, class Put>
void scaleInto(const settings::Size& from,
               const settings::Size& to,
               size_t channel_count,
               const Get& get,
               const Put& put) {
    const auto columns = tapsOf(from.width_px, to.width_px);
    for (const auto& row : tapsOf(from.height_px, to.height_px)) {
        for (const auto& column : columns) {
            const auto mix = [&](uint32_t y, size_t channel) {
                const size_t start = size_t{y} * from.width_px;
                return std::lerp(get(start + column.low, channel),
                                 get(start + column.high, channel), column.share);
            };
            for (size_t channel = 0; channel < channel_count; ++channel) {
                put(std::lerp(mix(row.low, channel), mix(row.high, channel), row.share));
            }
        }
    }
}

} // namespace

LinearImage scaled(const LinearImage& picture, const settings::Size& size) {
    LinearImage result{size.width_px, size.height_px, {}};
    result.rgb.reserve(size_t{size.width_px} * size.height_px * 3);
    scaleInto(
        {picture.width_px, picture.height_px}, size, 3,
        [&](size_t pixel, size_t channel) {
            return static_cast<double>(picture.rgb[pixel * 3 + channel]);
        },
        [&](double value) { result.rgb.push_back(static_cast<float>(value)); });
    return result;
}

std::vector<std::byte> scaled(const std::vector<std::byte>& rgba8,
                              const settings::Size& from,
                              const settings::Size& size) {
    FROXEL_ASSERT(rgba8.size() == size_t{from.width_px} * from.height_px * 4,
                  "the picture has padding or another size");
    std::vector<std::byte> result;
    result.reserve(size_t{size.width_px} * size.height_px * 4);
    scaleInto(
        from, size, 4,
        [&](size_t pixel, size_t channel) {
            return static_cast<double>(std::to_integer<uint32_t>(rgba8[pixel * 4 + channel]));
        },
        [&](double value) {
            result.push_back(static_cast<std::byte>(static_cast<uint8_t>(value + 0.5)));
        });
    return result;
}

} // namespace froxel::bench
