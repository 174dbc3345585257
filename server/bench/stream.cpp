#include "bench/stream.h"

#include "core/assert.h"
#include "core/clock.h"
#include "encode/jpeg_encoder.h"

#include <turbojpeg.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace froxel::bench {

namespace {

// RGBA8 without padding.
Result<std::vector<std::byte>>
decode(const std::vector<std::byte>& jpeg, uint32_t width_px, uint32_t height_px) {
    const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
    const auto failed = [&] {
        return Error{ErrorCode::kIo, std::string("TurboJPEG: ") + tjGetErrorStr2(handle.get())};
    };
    if (!handle) {
        return failed();
    }
    std::vector<std::byte> rgba(size_t{4} * width_px * height_px);
    const int status = tjDecompress2(
        handle.get(), reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size(),
        reinterpret_cast<unsigned char*>(rgba.data()), static_cast<int>(width_px), 0,
        static_cast<int>(height_px), TJPF_RGBA, TJFLAG_ACCURATEDCT);
    if (status != 0) {
        return failed();
    }
    return rgba;
}

} // namespace

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
    const auto decoded = decode(jpeg.value(), shown.width_px, shown.height_px);
    if (!decoded) {
        return decoded.error();
    }
    const PixelView seen{decoded.value().data(), shown.width_px, shown.height_px,
                         size_t{4} * shown.width_px};
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
