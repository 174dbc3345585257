// Planes of luma and chroma, as they come to the host. Pure.
#pragma once

#include "core/pixel_view.h"
#include "interface/planes_io.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>

namespace froxel::render {

// Rows end on words.
struct PlaneSizes {
    PlaneSizes() = default;
    // sampling: luma samples a chroma sample, across and down, 1 or 2.
    PlaneSizes(const settings::Size& size, uint32_t sampling);

    // Of all three, in words.
    [[nodiscard]] uint32_t lumaWords() const { return picture.luma_row * picture.height_px; }
    [[nodiscard]] uint32_t chromaWords() const {
        return picture.chroma_row * picture.chroma_height;
    }
    [[nodiscard]] uint64_t bytes() const {
        return sizeof(uint32_t) * (uint64_t{lumaWords()} + 2 * uint64_t{chromaWords()});
    }
    [[nodiscard]] PlaneView view(const std::byte* host) const;

    io::PlanesPicture picture{};
};

} // namespace froxel::render
