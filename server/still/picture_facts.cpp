#include "still/picture_facts.h"

#include "interface/debug_io.h"
#include "png/reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::still {

namespace {

using Rgba8 = std::array<uint8_t, 4>; // alpha: 255
using Rgba8Pixels = std::vector<Rgba8>;

bool isNearBlack(const Rgba8& at) {
    constexpr uint8_t kMost = 8;
    return std::max({at[0], at[1], at[2]}) <= kMost;
}

bool isNearWhite(const Rgba8& at) {
    constexpr uint8_t kLeast = 247;
    return std::min({at[0], at[1], at[2]}) >= kLeast;
}

Result<Rgba8Pixels> pixelsOf(const SharedBytes& png) {
    const auto size = png::readSize(*png);
    if (!size) {
        return size.error();
    }
    Rgba8Pixels pixels(size_t{size->width_px} * size->height_px);
    if (auto read = png::readPixels(*png, std::as_writable_bytes(std::span(pixels))); !read) {
        return read.error();
    }
    return pixels;
}

// What gives 1 modulo 2^32, times an odd number; each step doubles the bits that are right.
constexpr uint32_t inverse(uint32_t odd) {
    uint32_t x = odd; // three bits
    for (int bits = 3; bits < 32; bits *= 2) {
        x *= 2 - odd * x;
    }
    return x;
}
static_assert(inverse(io::kInstanceColorFactor) * io::kInstanceColorFactor == 1);

// Of the instance, from 1; 0: of none.
uint32_t numberAt(const Rgba8& at) {
    const uint32_t product = std::bit_cast<uint32_t>(at) ^ io::kDebugEmpty;
    return product * inverse(io::kInstanceColorFactor) & io::kInstanceColorMask;
}

template <class Is>
double share(const Rgba8Pixels& pixels, Is is) {
    return static_cast<double>(std::ranges::count_if(pixels, is)) /
           static_cast<double>(pixels.size());
}

} // namespace

Result<PictureFacts> factsOf(const SharedBytes& png) {
    const auto pixels = pixelsOf(png);
    if (!pixels) {
        return pixels.error();
    }
    return PictureFacts{share(*pixels, isNearBlack), share(*pixels, isNearWhite)};
}

Result<CoveredPixels> coveredPixels(const SharedBytes& png) {
    const auto pixels = pixelsOf(png);
    if (!pixels) {
        return pixels.error();
    }
    std::vector<uint32_t> numbers(pixels->size());
    std::ranges::transform(*pixels, numbers.begin(), numberAt);
    std::ranges::sort(numbers);
    CoveredPixels covered{numbers.size(), {}};
    for (auto at = std::ranges::upper_bound(numbers, 0U); at != numbers.end();) {
        const auto end = std::ranges::upper_bound(at, numbers.end(), *at);
        covered.of_instance.emplace(*at - 1, end - at);
        at = end;
    }
    return covered;
}

} // namespace froxel::still
