#include "reference/tone_map.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {

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

} // namespace

namespace {

// The inverse of pbrNeutral().
glm::dvec3 inverseNeutral(glm::dvec3 color) {
    constexpr double kFresnel = 0.04;
    constexpr double kStart = 0.8 - kFresnel;
    constexpr double kDesaturation = 0.15;
    constexpr double kRoom = 1 - kStart;
    constexpr double kWhite = 0.95;
    double new_peak = std::max({color.x, color.y, color.z});
    if (new_peak > kWhite) {
        color *= kWhite / new_peak;
        new_peak = kWhite;
    }
    if (new_peak > kStart) {
        const double peak = kRoom * kRoom / (1 - new_peak) + kStart - kRoom;
        const double kept = 1 / (kDesaturation * (peak - new_peak) + 1);
        color = glm::max((color - new_peak * (1 - kept)) / kept, glm::dvec3(0)) * (peak / new_peak);
    }
    const double least = std::min({color.x, color.y, color.z});
    return color + (least < kFresnel ? std::sqrt(4 * kFresnel * least) - least : kFresnel);
}

} // namespace

glm::dvec3 shownAs(const glm::dvec3& color, double exposure, settings::ToneMap tone_map) {
    return (tone_map == settings::ToneMap::kPbrNeutral ? inverseNeutral(glm::clamp(color, 0.0, 1.0))
                                                       : color) /
           exposure;
}

glm::dvec3 toneMapped(const glm::dvec3& radiance, double exposure, settings::ToneMap tone_map) {
    constexpr double kBrightest = 1e6; // white, and no infinity in what follows
    const glm::dvec3 exposed = glm::min(radiance * exposure, glm::dvec3(kBrightest));
    return tone_map == settings::ToneMap::kPbrNeutral ? pbrNeutral(exposed) : exposed;
}

} // namespace froxel::reference
