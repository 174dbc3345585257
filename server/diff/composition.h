// Two pictures as one. Pure functions, any thread. Both views have the same size and are not empty
// (FROXEL_ASSERT); what comes back is RGBA8, [height][width][4], alpha 255.
#pragma once

#include "core/pixel_view.h"

#include <cstddef>
#include <vector>

namespace froxel::diff {

// The left one above the right one: twice as high.
[[nodiscard]] std::vector<std::byte> stacked(const PixelView& left, const PixelView& right);

// The left one's part left of `split`, a share of the width, and the right one's beyond it, with a
// white line of two pixels between them, if both show.
[[nodiscard]] std::vector<std::byte>
divided(const PixelView& left, const PixelView& right, double split);

} // namespace froxel::diff
