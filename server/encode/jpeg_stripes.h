// One baseline JPEG out of stripes that were encoded apart, so that several threads share a
// picture. Every stripe's data starts as data does after a restart marker (ITU-T T.81, F.1.1.5.1
// and G.1.1): on a byte, with DC prediction from 0. Joined by restart markers they are what one
// encoder with that restart interval would have made, and decode to the same pixels as without
// stripes.
#pragma once

#include "core/error.h"
#include "core/pixel_view.h"
#include "settings/settings.h"

#include <cstddef>
#include <span>
#include <vector>

namespace froxel::encode {

// Horizontal parts of equal height but for the last, about `wanted`: whole rows of the format's
// blocks, none so small that handing it to a thread would cost more than it saves, none larger than
// a restart interval may be where there are several.
[[nodiscard]] std::vector<PixelView>
cutStripes(const PixelView& pixels, settings::Chroma chroma, size_t wanted);

// `stripes` are JpegEncoder's for the parts of one cutStripes(), in order, with one quality and
// chroma; `height_px` is the whole picture's. Errors: kIo where a stripe is not such a JPEG.
[[nodiscard]] Result<std::vector<std::byte>>
joinStripes(std::span<const std::vector<std::byte>> stripes, uint32_t height_px);

} // namespace froxel::encode
