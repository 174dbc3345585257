#include "load/jpeg_check.h"

#include "core/text.h"

#include <optional>

namespace froxel::load {
namespace {

constexpr uint8_t kStartOfImage = 0xD8;
constexpr uint8_t kEndOfImage = 0xD9;
constexpr uint8_t kStartOfScan = 0xDA;

uint32_t byteAt(protocol::ByteSpan bytes, size_t at) {
    return std::to_integer<uint32_t>(bytes[at]);
}

uint32_t wordAt(protocol::ByteSpan bytes, size_t at) {
    return byteAt(bytes, at) << 8U | byteAt(bytes, at + 1);
}

bool hasMarker(protocol::ByteSpan bytes, size_t at, uint8_t marker) {
    return wordAt(bytes, at) == (0xFF00U | marker);
}

// SOF0 to SOF15 but for DHT, JPG and DAC, which lie among them.
bool isStartOfFrame(uint32_t marker) {
    return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

Error broken(const std::string& what) {
    return {ErrorCode::kInvalidArgument, "JPEG: " + what};
}

} // namespace

Result<JpegSize> checkJpeg(protocol::ByteSpan bytes) {
    if (bytes.size() < 4 || !hasMarker(bytes, 0, kStartOfImage)) {
        return broken("no start of image in " + numberText(bytes.size()) + " bytes");
    }
    if (!hasMarker(bytes, bytes.size() - 2, kEndOfImage)) {
        return broken("no end of image in the last of " + numberText(bytes.size()) + " bytes");
    }
    std::optional<JpegSize> size;
    for (size_t at = 2; at + 4 <= bytes.size();) {
        if (byteAt(bytes, at) != 0xFF) {
            return broken("no marker at byte " + numberText(at));
        }
        const uint32_t marker = byteAt(bytes, at + 1);
        if (marker == kStartOfScan) {
            return size ? Result<JpegSize>(*size) : broken("a scan before any frame header");
        }
        const uint32_t length = wordAt(bytes, at + 2);
        if (length < 2 || length > bytes.size() - at - 2) {
            return broken("a segment of " + numberText(length) + " bytes at byte " +
                          numberText(at));
        }
        if (isStartOfFrame(marker)) {
            if (length < 8) {
                return broken("a frame header of " + numberText(length) + " bytes");
            }
            size = JpegSize{wordAt(bytes, at + 7), wordAt(bytes, at + 5)};
        }
        at += 2 + length;
    }
    return broken("no scan");
}

} // namespace froxel::load
