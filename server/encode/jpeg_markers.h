// Where the parts of a baseline JPEG lie (ITU-T T.81, annex B).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace froxel::encode {

// T.81, table B.1.
namespace marker {
inline constexpr uint8_t kSof0 = 0xC0;
inline constexpr uint8_t kDht = 0xC4;
inline constexpr uint8_t kRst0 = 0xD0;
inline constexpr uint8_t kSoi = 0xD8;
inline constexpr uint8_t kEoi = 0xD9;
inline constexpr uint8_t kSos = 0xDA;
inline constexpr uint8_t kDqt = 0xDB;
inline constexpr uint8_t kDri = 0xDD;
} // namespace marker

// A marker with what follows it.
struct JpegSegment {
    uint8_t marker = 0;
    size_t at = 0;                      // of the marker, in bytes from the start
    std::span<const std::byte> payload; // behind its length
};

struct JpegParts {
    std::vector<JpegSegment> segments; // from the first behind SOI to the scan's header
    size_t data = 0;                   // first entropy-coded byte
    size_t end = 0;                    // EOI

    // The first of a kind; null: there is none.
    [[nodiscard]] const JpegSegment* find(uint8_t marker) const;
};

// None: not one JPEG of one baseline scan.
[[nodiscard]] std::optional<JpegParts> partsOf(std::span<const std::byte> jpeg);

[[nodiscard]] uint32_t jpegByte(std::span<const std::byte> bytes, size_t at);
[[nodiscard]] uint32_t jpegWord(std::span<const std::byte> bytes, size_t at); // 16 bits

// The frame header's fields (T.81, B.2.2).
struct JpegSize {
    uint32_t height_px = 0;
    uint32_t width_px = 0;
    uint32_t luma_sampling = 1;
    size_t at = 0; // of the height, in bytes from the file's start; the width follows
};
[[nodiscard]] std::optional<JpegSize> sizeOf(const JpegParts& parts);

} // namespace froxel::encode
