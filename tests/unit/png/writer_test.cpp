#include "png/reader.h"
#include "png/writer.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

#include <string_view>

namespace froxel::png {
namespace {

using encode::makePicture;
using encode::Picture;

struct Decoded {
    PictureSize size;
    std::vector<std::byte> rgba8;
};

Decoded decoded(const std::vector<std::byte>& file) {
    Decoded picture{readSize(file).value(), {}};
    picture.rgba8.resize(size_t{picture.size.width_px} * picture.size.height_px * 4);
    readPixels(file, picture.rgba8).value();
    return picture;
}

// As makePicture, with an alpha of its own at every pixel.
Picture translucent(uint32_t width_px, size_t padding_bytes) {
    Picture picture = makePicture(width_px, 19, padding_bytes);
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < width_px; ++x) {
            picture.bytes[y * picture.stride_bytes + x * 4 + 3] = static_cast<std::byte>(x + 5 * y);
        }
    }
    return picture;
}

void expectSame(const Decoded& read, const Picture& written, bool opaque) {
    ASSERT_EQ(read.size.width_px, written.width_px);
    ASSERT_EQ(read.size.height_px, written.height_px);
    size_t i = 0;
    for (uint32_t y = 0; y < written.height_px; ++y) {
        for (uint32_t x = 0; x < written.width_px; ++x) {
            for (uint32_t c = 0; c < 4; ++c) {
                const int right = opaque && c == 3 ? 255 : written.channel(x, y, c);
                ASSERT_EQ(std::to_integer<int>(read.rgba8[i++]), right) << x << " " << y;
            }
        }
    }
}

TEST(Write, EveryLayout_ComesBackToTheBit) {
    for (const uint32_t width : {1U, 7U, 64U, 333U}) {
        for (const size_t padding : {0U, 12U}) {
            const Picture picture = translucent(width, padding);
            for (const auto compression : {Compression::kFast, Compression::kDefault}) {
                const auto rgb = write(picture.view(), {Channels::kRgb, compression, true});
                expectSame(decoded(rgb.value()), picture, true);
                const auto rgba = write(picture.view(), {Channels::kRgba, compression, false});
                expectSame(decoded(rgba.value()), picture, false);
            }
        }
    }
}

TEST(Write, ColourSpace_IsToldWhereAskedFor) {
    const Picture picture = makePicture(8, 8);
    const auto told = [&](bool srgb) {
        const auto file = write(picture.view(), {.srgb = srgb}).value();
        const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
        return text.find("sRGB") != std::string_view::npos;
    };
    EXPECT_TRUE(told(true));
    EXPECT_FALSE(told(false));
}

TEST(Write, EmptyOrNarrowView_IsRefused) {
    EXPECT_EQ(write({}).error().code, ErrorCode::kInvalidArgument);
    const Picture picture = makePicture(8, 8);
    PixelView view = picture.view();
    view.stride_bytes = 31;
    EXPECT_EQ(write(view).error().message, "PNG of 8x8 pixels in rows of 31 bytes");
}

} // namespace
} // namespace froxel::png
