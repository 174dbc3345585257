// Linear radiance to the 8 bits that are shown, in double: what the device's last pass should give.
#pragma once

#include "core/linear_image.h"
#include "settings/settings.h"

#include <cstddef>
#include <vector>

namespace froxel::bench {

// Exposure, tone map (Khronos PBR Neutral, Khronos 2024, or a clamp), sRGB (IEC 61966-2-1), rounded
// to nearest. [height][width][4], alpha 255. NaN becomes 0.
[[nodiscard]] std::vector<std::byte>
shownPicture(const LinearImage& radiance, double exposure, settings::ToneMap tone_map);

} // namespace froxel::bench
