// Pixels whose rows follow each other without padding.
#pragma once

#include "core/pixel_view.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace froxel {

// `rgba8`: [height][width][4], borrowed.
[[nodiscard]] inline PixelView
packedView(std::span<const std::byte> rgba8, uint32_t width_px, uint32_t height_px) {
    return {rgba8.data(), width_px, height_px, size_t{4} * width_px};
}

} // namespace froxel
