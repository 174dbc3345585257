// Pictures scaled as a canvas scales them: bilinear between pixel centres, edges repeated. Pure.
#pragma once

#include "core/linear_image.h"
#include "settings/settings.h"

#include <cstddef>
#include <vector>

namespace froxel::bench {

[[nodiscard]] LinearImage scaled(const LinearImage& picture, const settings::Size& size);

// RGBA8 without padding: the stored sRGB values are mixed, not the light they stand for; rounded to
// nearest.
[[nodiscard]] std::vector<std::byte>
scaled(const std::vector<std::byte>& rgba8, const settings::Size& from, const settings::Size& size);

} // namespace froxel::bench
