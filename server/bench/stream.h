// What a stream's JPEG costs: bytes, time, and the decoded picture's distance from the one it
// encodes.
#pragma once

#include "core/error.h"
#include "core/pixel_view.h"
#include "image_metrics/picture_error.h"
#include "report/statistics.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>

namespace froxel::bench {

struct StreamError {
    settings::Encoding encoding;
    uint64_t bytes = 0;
    double bits_per_pixel = 0;
    report::Summary encode_us; // on this thread, one encoder, warmed up
    image_metrics::DifferenceStats shown;
    image_metrics::PerceivedStats perceived;
};

// Encodes as the stream does, `encode_count` (1 or more) times and once before to warm up, and
// decodes with TurboJPEG's accurate transform and smooth chroma, as browsers do. Errors: those of
// encode::JpegEncoder; kIo with TurboJPEG's text when its own picture does not decode.
[[nodiscard]] Result<StreamError>
measureStream(const PixelView& shown, const settings::Encoding& encoding, size_t encode_count);

} // namespace froxel::bench
