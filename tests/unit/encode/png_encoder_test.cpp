#include "encode/png_encoder.h"
#include "picture.h"

#include <gtest/gtest.h>
#include <png.h>

namespace froxel::encode {
namespace {

std::vector<unsigned char> decodePng(const std::vector<std::byte>& bytes, uint32_t& width) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
    image.format = PNG_FORMAT_RGB;
    width = image.width;
    std::vector<unsigned char> rgb(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
    return rgb;
}

TEST(EncodePng, AnyPicture_ComesBackToTheBit) {
    for (const uint32_t width : {1U, 7U, 64U, 333U}) {
        for (const size_t padding : {0U, 12U}) {
            const Picture picture = makePicture(width, 19, padding);
            uint32_t decoded_width = 0;
            const auto rgb = decodePng(encodePng(picture.view()).value(), decoded_width);
            ASSERT_EQ(decoded_width, width);
            ASSERT_EQ(rgb.size(), size_t{3} * width * 19);
            for (uint32_t y = 0; y < 19; ++y) {
                for (uint32_t x = 0; x < width; ++x) {
                    for (uint32_t c = 0; c < 3; ++c) {
                        ASSERT_EQ(rgb[(y * width + x) * 3 + c], picture.channel(x, y, c));
                    }
                }
            }
        }
    }
}

TEST(EncodePng, EmptyOrNarrowView_IsRefused) {
    EXPECT_EQ(encodePng({}).error().code, ErrorCode::kInvalidArgument);
    const Picture picture = makePicture(8, 8);
    PixelView view = picture.view();
    view.stride_bytes = 31;
    EXPECT_EQ(encodePng(view).error().message, "PNG of 8x8 pixels in rows of 31 bytes");
}

} // namespace
} // namespace froxel::encode
