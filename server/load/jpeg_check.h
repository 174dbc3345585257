// Whether bytes look like one whole JPEG, by its markers alone: nothing is decoded.
#pragma once

#include "core/error.h"
#include "protocol/framing.h"

#include <cstdint>

namespace froxel::load {

struct JpegSize {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    bool operator==(const JpegSize&) const = default;
};

// The size in its frame header (ITU-T T.81, B.2.2): start of image, segments up to the start of
// frame and on to a start of scan, end of image in the last two bytes. Pure; reads a few hundred
// bytes. Errors: kInvalidArgument, saying which is missing.
[[nodiscard]] Result<JpegSize> checkJpeg(protocol::ByteSpan bytes);

} // namespace froxel::load
