// How a baseline JPEG is coded (ITU-T T.81): all that an encoder has to know besides the pixels to
// make the file that another encoder makes, byte for byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel {

// Coefficients of a block.
inline constexpr size_t kJpegBlock = 64;

// By place in the scan, the coefficient's place in the block by rows (T.81, figure A.6).
inline constexpr std::array<uint8_t, kJpegBlock> kJpegZigzag = {
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

// The cosine transform in integers, as libjpeg has it.
enum class JpegTransform : uint8_t { kAccurate, kFast }; // its "islow" and "ifast"

struct HuffmanCode {
    uint16_t bits = 0;
    uint8_t length = 0; // 0: the symbol has no code
};

struct JpegFormat {
    // Of luma and of both chroma components.
    struct Tables {
        std::array<uint16_t, kJpegBlock> quantisation{}; // by rows
        std::array<HuffmanCode, 16> dc{};                // by the bits of a difference
        std::array<HuffmanCode, 256> ac{};               // by zeros << 4 | bits of a coefficient
    };

    uint32_t luma_sampling = 1; // luma samples a chroma sample, across and down: 1 or 2
    JpegTransform transform = JpegTransform::kAccurate;
    Tables luma = {};
    Tables chroma = {};
    std::vector<std::byte> header =
        {};             // all before the scan's first byte, of a picture of another size
    size_t size_at = 0; // in it: height and width in pixels, each 16 bits, big-endian
};

} // namespace froxel
