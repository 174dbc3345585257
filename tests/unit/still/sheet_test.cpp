#include "core/pixel_view.h"
#include "interface/debug_io.h"
#include "png/reader.h"
#include "png/writer.h"
#include "still/picture_facts.h"
#include "still/sheet.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace froxel::still {
namespace {

using Pixel = std::array<uint8_t, 4>;

struct Picture {
    uint32_t width_px = 0;
    std::vector<Pixel> pixels;
    [[nodiscard]] const Pixel& at(uint32_t x, uint32_t y) const {
        return pixels[size_t{y} * width_px + x];
    }
};

SharedBytes pngOf(uint32_t width, std::vector<Pixel> pixels) {
    const PixelView view{reinterpret_cast<const std::byte*>(pixels.data()), width,
                         static_cast<uint32_t>(pixels.size() / width), size_t{width} * 4};
    return std::make_shared<const std::vector<std::byte>>(png::write(view).value());
}

Picture pictureOf(const SharedBytes& png) {
    const auto size = png::readSize(*png).value();
    Picture picture{size.width_px, std::vector<Pixel>(size_t{size.width_px} * size.height_px)};
    png::readPixels(*png, std::as_writable_bytes(std::span(picture.pixels))).value();
    return picture;
}

constexpr uint32_t kWidth = 80;
constexpr uint32_t kHeight = 60;

// So many parts, each of its own red.
std::vector<SheetPart> partsOf(size_t count) {
    std::vector<SheetPart> parts;
    for (size_t i = 0; i < count; ++i) {
        const Pixel color{static_cast<uint8_t>(20 * (i + 1)), 100, 200, 255};
        parts.push_back(
            {"iso", pngOf(kWidth, std::vector<Pixel>(size_t{kWidth} * kHeight, color))});
    }
    return parts;
}

settings::Encoding asPng() {
    settings::Encoding encoding;
    encoding.codec = settings::Codec::kPng;
    return encoding;
}

TEST(Sheet, PartsFollowFromLeftToRightAndDown) {
    const std::array<std::array<uint32_t, 3>, 4> cases{
        {{1, 1, 1}, {2, 2, 1}, {5, 3, 2}, {9, 3, 3}}};
    for (const auto& [count, columns, rows] : cases) {
        const Picture sheet = pictureOf(makeSheet(partsOf(count), asPng()).value());
        ASSERT_EQ(sheet.width_px, columns * kWidth);
        ASSERT_EQ(sheet.pixels.size(), size_t{columns} * rows * kWidth * kHeight);
        for (uint32_t i = 0; i < columns * rows; ++i) {
            const Pixel& middle =
                sheet.at(i % columns * kWidth + kWidth / 2, i / columns * kHeight + kHeight / 2);
            EXPECT_EQ(middle[0], i < count ? 20 * (i + 1) : 0) << count << " " << i;
        }
    }
}

// White letters on black above the left corner, and nothing of them elsewhere.
TEST(Sheet, EachPart_HasItsLabel) {
    const Picture sheet = pictureOf(makeSheet(partsOf(2), asPng()).value());
    for (uint32_t part = 0; part < 2; ++part) {
        size_t white = 0;
        size_t black = 0;
        for (uint32_t y = 0; y < kHeight; ++y) {
            for (uint32_t x = 0; x < kWidth; ++x) {
                const Pixel& pixel = sheet.at(part * kWidth + x, y);
                const bool is_white = pixel == Pixel{255, 255, 255, 255};
                const bool is_black = pixel == Pixel{0, 0, 0, 255};
                white += is_white ? 1U : 0U;
                black += is_black ? 1U : 0U;
                EXPECT_TRUE(!(is_white || is_black) || (x < 30 && y < 12)) << x << " " << y;
            }
        }
        EXPECT_GT(white, 20U);
        EXPECT_GT(black, white);
    }
}

TEST(Sheet, Jpeg_IsOne) {
    settings::Encoding encoding;
    encoding.codec = settings::Codec::kJpeg;
    const auto sheet = makeSheet(partsOf(4), encoding).value();
    EXPECT_EQ((*sheet)[0], std::byte{0xFF});
    EXPECT_EQ((*sheet)[1], std::byte{0xD8});
}

TEST(Sheet, TooLargeOrBroken_IsAnError) {
    const SharedBytes large = pngOf(4096, std::vector<Pixel>(size_t{4096} * 2049));
    std::vector<SheetPart> parts(4, {"front", large});
    const auto sheet = makeSheet(parts, asPng());
    ASSERT_FALSE(sheet);
    EXPECT_EQ(sheet.error().code, ErrorCode::kCapacity);
    auto broken = partsOf(2);
    broken[1].png = std::make_shared<const std::vector<std::byte>>(100);
    EXPECT_FALSE(makeSheet(broken, asPng()));
    auto other_size = partsOf(2);
    other_size[1].png = pngOf(2, std::vector<Pixel>(4));
    EXPECT_FALSE(makeSheet(other_size, asPng()));
}

// What shaders/debug_view.comp stores.
Pixel colorOfInstance(uint32_t instance) {
    const uint32_t product = (instance + 1) * io::kInstanceColorFactor & io::kInstanceColorMask;
    return std::bit_cast<Pixel>(io::kDebugEmpty ^ product);
}

TEST(PictureFacts, CoveredPixels_AreCountedByTheInstanceOfTheirColour) {
    const Pixel empty = std::bit_cast<Pixel>(io::kDebugEmpty);
    constexpr uint32_t kLast = (1U << 24U) - 2;
    const Pixel first = colorOfInstance(0);
    const Pixel last = colorOfInstance(kLast);
    const auto covered =
        coveredPixels(pngOf(2, {empty, last, first, last, empty, colorOfInstance(1)}));
    ASSERT_TRUE(covered) << covered.error().message;
    EXPECT_EQ(covered->total, 6U);
    EXPECT_EQ(covered->of_instance, (std::map<uint32_t, uint64_t>{{0, 1}, {1, 1}, {kLast, 2}}));
    EXPECT_TRUE(coveredPixels(pngOf(1, {empty}))->of_instance.empty());
    EXPECT_FALSE(coveredPixels(std::make_shared<const std::vector<std::byte>>(3)));
}

TEST(PictureFacts, SharesOfNearlyBlackAndWhite) {
    const Pixel black{8, 0, 8, 255};
    const Pixel dark{9, 0, 0, 255};
    const Pixel white{247, 255, 247, 255};
    const Pixel bright{246, 255, 255, 255};
    const auto facts = factsOf(pngOf(4, {black, black, dark, white, bright, bright, dark, dark}));
    EXPECT_DOUBLE_EQ(facts->near_black, 0.25);
    EXPECT_DOUBLE_EQ(facts->near_white, 0.125);
    EXPECT_FALSE(factsOf(std::make_shared<const std::vector<std::byte>>(3)));
}

} // namespace
} // namespace froxel::still
