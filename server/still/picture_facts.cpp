#include "still/picture_facts.h"

#include "png/reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::still {

Result<PictureFacts> factsOf(const SharedBytes& png) {
    constexpr uint8_t kBlack = 8;
    constexpr uint8_t kWhite = 247;
    const auto size = png::readSize(*png);
    if (!size) {
        return size.error();
    }
    std::vector<std::array<uint8_t, 4>> pixels(size_t{size->width_px} * size->height_px);
    if (auto read = png::readPixels(*png, std::as_writable_bytes(std::span(pixels))); !read) {
        return read.error();
    }
    size_t black = 0;
    size_t white = 0;
    for (const auto& [red, green, blue, alpha] : pixels) {
        black += std::max({red, green, blue}) <= kBlack ? 1U : 0U;
        white += std::min({red, green, blue}) >= kWhite ? 1U : 0U;
    }
    const auto all = static_cast<double>(pixels.size());
    return PictureFacts{static_cast<double>(black) / all, static_cast<double>(white) / all};
}

} // namespace froxel::still
