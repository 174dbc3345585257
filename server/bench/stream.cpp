#include "bench/stream.h"

#include "core/assert.h"
#include "core/clock.h"
#include "core/packed_pixels.h"
#include "encode/jpeg_encoder.h"
#include "jpeg/reader.h"

#include <utility>
#include <vector>

namespace froxel::bench {

Result<StreamError>
measureStream(const PixelView& shown, const settings::Encoding& encoding, size_t encode_count) {
    FROXEL_ASSERT(encode_count > 0, "a time needs a sample");
    encode::JpegEncoder encoder;
    auto jpeg = encoder.encode(shown, encoding);
    std::vector<double> encode_us;
    for (size_t i = 0; jpeg && i < encode_count; ++i) {
        const auto start = Clock::now();
        jpeg = encoder.encode(shown, encoding);
        encode_us.push_back(Microseconds(Clock::now() - start).count());
    }
    if (!jpeg) {
        return jpeg.error();
    }
    std::vector<std::byte> decoded(size_t{4} * shown.width_px * shown.height_px);
    if (const auto read = jpeg::readPixels(jpeg.value(), decoded); !read) {
        return read.error();
    }
    const PixelView seen = packedView(decoded, shown.width_px, shown.height_px);
    const auto bytes = jpeg.value().size();
    return StreamError{.encoding = encoding,
                       .bytes = bytes,
                       .bits_per_pixel = 8.0 * static_cast<double>(bytes) /
                                         (static_cast<double>(shown.width_px) * shown.height_px),
                       .encode_us = report::summarize(std::move(encode_us)),
                       .shown = image_metrics::shownDifference(seen, shown),
                       .perceived = image_metrics::perceivedDifference(seen, shown)};
}

} // namespace froxel::bench
