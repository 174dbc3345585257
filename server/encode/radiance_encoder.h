// The picture before exposure and tone map as files of floats, to the bit as drawn (samples' mean),
// Rec. 709 primaries, without compression.
#pragma once

#include "core/linear_image.h"
#include "encode/encoder.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace froxel::encode {

// An OpenEXR file: scan lines of float R, G and B, and Z where the depth is known. Errors:
// kInvalidArgument for an image without pixels or of another number of values, kIo with what the
// library says. Throws std::bad_alloc.
[[nodiscard]] Result<std::vector<std::byte>> exrOf(const LinearImage& image);

// A portable float map: rows bottom-up, little endian. Errors as above.
[[nodiscard]] Result<std::vector<std::byte>> pfmOf(const LinearImage& image);

// Their pictures need Output::kRadiance.
[[nodiscard]] std::unique_ptr<Encoder> makeExrEncoder(size_t thread_count);
[[nodiscard]] std::unique_ptr<Encoder> makePfmEncoder(size_t thread_count);

} // namespace froxel::encode
