#include "bench/shown_picture.h"

#include "core/math.h"
#include "reference/tone_map.h"

#include <algorithm>
#include <cmath>

namespace froxel::bench {

namespace {

std::byte encoded(double linear) {
    const double c = linear > 0 ? std::min(linear, 1.0) : 0.0; // NaN too
    const double srgb = c < 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::byte>(static_cast<uint8_t>(srgb * 255 + 0.5));
}

} // namespace

std::vector<std::byte>
shownPicture(const LinearImage& radiance, double exposure, settings::ToneMap tone_map) {
    std::vector<std::byte> rgba8;
    rgba8.reserve(radiance.rgb.size() / 3 * 4);
    for (size_t i = 0; i + 2 < radiance.rgb.size(); i += 3) {
        const glm::dvec3 color = reference::toneMapped(
            {radiance.rgb[i], radiance.rgb[i + 1], radiance.rgb[i + 2]}, exposure, tone_map);
        for (int channel = 0; channel < 3; ++channel) {
            rgba8.push_back(encoded(color[channel]));
        }
        rgba8.push_back(std::byte{255});
    }
    return rgba8;
}

} // namespace froxel::bench
