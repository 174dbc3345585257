#include "bench/shown_picture.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>

namespace froxel::bench {

namespace {

glm::dvec3 pbrNeutral(const glm::dvec3& color) {
    constexpr double kFresnel = 0.04; // of what common materials reflect head-on
    constexpr double kStart = 0.8 - kFresnel;
    constexpr double kDesaturation = 0.15;
    const double least = std::min({color.x, color.y, color.z});
    const double offset = least < 2 * kFresnel ? least - least * least / (4 * kFresnel) : kFresnel;
    const glm::dvec3 lifted = color - offset;
    const double peak = std::max({lifted.x, lifted.y, lifted.z});
    if (peak < kStart) {
        return lifted;
    }
    constexpr double kRoom = 1 - kStart;
    const double new_peak = 1 - kRoom * kRoom / (peak + kRoom - kStart);
    const double kept = 1 / (kDesaturation * (peak - new_peak) + 1);
    return lifted * (new_peak / peak) * kept + new_peak * (1 - kept);
}

std::byte encoded(double linear) {
    const double c = linear > 0 ? std::min(linear, 1.0) : 0.0; // NaN too
    const double srgb = c < 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::byte>(static_cast<uint8_t>(srgb * 255 + 0.5));
}

} // namespace

std::vector<std::byte>
shownPicture(const LinearImage& radiance, double exposure, settings::ToneMap tone_map) {
    constexpr double kBrightest = 1e6; // white, and no infinity in what follows
    std::vector<std::byte> rgba8;
    rgba8.reserve(radiance.rgb.size() / 3 * 4);
    for (size_t i = 0; i + 2 < radiance.rgb.size(); i += 3) {
        glm::dvec3 color(radiance.rgb[i], radiance.rgb[i + 1], radiance.rgb[i + 2]);
        color = glm::min(color * exposure, glm::dvec3(kBrightest));
        if (tone_map == settings::ToneMap::kPbrNeutral) {
            color = pbrNeutral(color);
        }
        for (int channel = 0; channel < 3; ++channel) {
            rgba8.push_back(encoded(color[channel]));
        }
        rgba8.push_back(std::byte{255});
    }
    return rgba8;
}

} // namespace froxel::bench
