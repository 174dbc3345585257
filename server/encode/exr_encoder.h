// The picture before exposure and tone map, as OpenEXR files: scan lines of float R, G and B, to
// the bit as drawn (samples' mean), Rec. 709 primaries, no compression.
#pragma once

#include "encode/encoder.h"

#include <cstddef>
#include <memory>

namespace froxel::encode {

// Its pictures need PixelView::radiance.
[[nodiscard]] std::unique_ptr<Encoder> makeExrEncoder(size_t thread_count);

} // namespace froxel::encode
