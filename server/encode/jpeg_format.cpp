#include "encode/jpeg_format.h"

#include "core/pixel_view.h"
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_markers.h"

#include <array>
#include <span>
#include <vector>

namespace froxel::encode {

namespace {

using Bytes = std::span<const std::byte>;

// Of a table's destination: luma's are 0, chroma's 1. Null: another.
JpegFormat::Tables* tablesOf(JpegFormat& format, uint32_t destination) {
    return destination == 0 ? &format.luma : destination == 1 ? &format.chroma : nullptr;
}

// T.81, B.2.4.1. Whether it is well formed.
bool readQuantisation(Bytes payload, JpegFormat& format) {
    while (!payload.empty()) {
        auto* tables = tablesOf(format, jpegByte(payload, 0)); // upper half: 0, 8 bits a value
        if (tables == nullptr || payload.size() < 1 + kJpegBlock) {
            return false;
        }
        for (size_t i = 0; i < kJpegBlock; ++i) {
            tables->quantisation[kJpegZigzag[i]] = static_cast<uint16_t>(jpegByte(payload, 1 + i));
        }
        payload = payload.subspan(1 + kJpegBlock);
    }
    return true;
}

// T.81, B.2.4.2 and annex C: codes of one length count up, those of the next begin behind them.
bool readHuffman(Bytes payload, JpegFormat& format) {
    constexpr size_t kLengths = 16;
    while (!payload.empty()) {
        const uint32_t kind = jpegByte(payload, 0);
        auto* tables = tablesOf(format, kind & 15U);
        if (tables == nullptr || kind >> 4U > 1 || payload.size() < 1 + kLengths) {
            return false;
        }
        const std::span<HuffmanCode> codes =
            kind >> 4U == 0 ? std::span<HuffmanCode>(tables->dc) : std::span(tables->ac);
        const Bytes counts = payload.subspan(1, kLengths);
        payload = payload.subspan(1 + kLengths);
        uint32_t next = 0;
        for (size_t i = 0; i < kLengths; ++i, next *= 2) {
            const uint32_t count = jpegByte(counts, i);
            if (payload.size() < count) {
                return false;
            }
            for (uint32_t k = 0; k < count; ++k) {
                const uint32_t symbol = jpegByte(payload, k);
                if (symbol >= codes.size()) {
                    return false;
                }
                codes[symbol] = {static_cast<uint16_t>(next++), static_cast<uint8_t>(i + 1)};
            }
            payload = payload.subspan(count);
        }
    }
    return true;
}

} // namespace

Result<JpegFormat> jpegFormat(const settings::Encoding& encoding) {
    constexpr uint32_t kSide_px = 16;
    const std::array<std::byte, size_t{4} * kSide_px * kSide_px> black{};
    const PixelView pixels{.data = black.data(),
                           .width_px = kSide_px,
                           .height_px = kSide_px,
                           .stride_bytes = size_t{4} * kSide_px};
    const auto jpeg = JpegEncoder().encode(pixels, encoding);
    if (!jpeg) {
        return jpeg.error();
    }
    const auto parts = partsOf(*jpeg);
    if (!parts) {
        return Error{ErrorCode::kIo, "TurboJPEG made what is not a baseline JPEG"};
    }
    const JpegSize size = *sizeOf(*parts);
    JpegFormat format{
        .luma_sampling = size.luma_sampling,
        .transform = jpegTransform(encoding.quality),
        .header = {jpeg->begin(), jpeg->begin() + static_cast<std::ptrdiff_t>(parts->data)},
        .size_at = size.at};
    for (const JpegSegment& segment : parts->segments) {
        const bool read = segment.marker == marker::kDqt ? readQuantisation(segment.payload, format)
                          : segment.marker == marker::kDht ? readHuffman(segment.payload, format)
                                                           : true;
        if (!read) {
            return Error{ErrorCode::kIo, "TurboJPEG made a JPEG with tables of another kind"};
        }
    }
    return format;
}

Result<std::shared_ptr<const JpegFormat>> JpegFormats::of(const settings::Encoding& encoding) {
    auto& made = made_[{encoding.quality, encoding.chroma}];
    if (!made) {
        auto format = jpegFormat(encoding);
        if (!format) {
            return format.error();
        }
        made = std::make_shared<const JpegFormat>(std::move(*format));
    }
    return made;
}

} // namespace froxel::encode
