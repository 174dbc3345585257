#include "encode/jpeg_markers.h"

#include <algorithm>

namespace froxel::encode {

uint32_t jpegByte(std::span<const std::byte> bytes, size_t at) {
    return std::to_integer<uint32_t>(bytes[at]);
}

uint32_t jpegWord(std::span<const std::byte> bytes, size_t at) {
    return jpegByte(bytes, at) << 8U | jpegByte(bytes, at + 1);
}

const JpegSegment* JpegParts::find(uint8_t marker) const {
    const auto found = std::ranges::find(segments, marker, &JpegSegment::marker);
    return found != segments.end() ? &*found : nullptr;
}

std::optional<JpegParts> partsOf(std::span<const std::byte> jpeg) {
    JpegParts parts;
    if (jpeg.size() < 4 || jpegWord(jpeg, 0) != (0xFF00U | marker::kSoi) ||
        jpegWord(jpeg, jpeg.size() - 2) != (0xFF00U | marker::kEoi)) {
        return std::nullopt;
    }
    parts.end = jpeg.size() - 2;
    for (size_t at = 2; at + 4 <= parts.end && jpegByte(jpeg, at) == 0xFF;) {
        const size_t next = at + 2 + jpegWord(jpeg, at + 2);
        if (next > parts.end || next < at + 4) {
            return std::nullopt;
        }
        const auto kind = static_cast<uint8_t>(jpegByte(jpeg, at + 1));
        parts.segments.push_back({kind, at, jpeg.subspan(at + 4, next - at - 4)});
        if (kind == marker::kSos) {
            parts.data = next;
            return sizeOf(parts) ? std::optional(std::move(parts)) : std::nullopt;
        }
        at = next;
    }
    return std::nullopt;
}

std::optional<JpegSize> sizeOf(const JpegParts& parts) {
    const JpegSegment* frame = parts.find(marker::kSof0);
    if (frame == nullptr || frame->payload.size() < 9) {
        return std::nullopt;
    }
    const JpegSize size{.height_px = jpegWord(frame->payload, 1),
                        .width_px = jpegWord(frame->payload, 3),
                        .luma_sampling = jpegByte(frame->payload, 7) >> 4U,
                        .at = frame->at + 5};
    return size.luma_sampling != 0 ? std::optional(size) : std::nullopt;
}

} // namespace froxel::encode
