#include "diff/picture.h"
#include "encode/jpeg_encoder.h"
#include "encode/radiance_encoder.h"
#include "png/writer.h"
#include "unit/diff/pictures.h"

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::diff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string faultOf(const std::string& file) {
    const auto read = decode(bytesOf(file), "a.pic");
    return read ? "read" : read.error().message;
}

TEST(PictureFile, Png_IsReadAsItWasWritten) {
    ShownPicture picture = shown(3, 2, 9);
    picture.rgba8[4] = std::byte{200};
    const auto file = decode(png::write(picture.view()).value(), "a.png").value();
    EXPECT_EQ(std::get<ShownPicture>(file.picture).rgba8, picture.rgba8);
    EXPECT_THAT(file.warnings, testing::IsEmpty());
}

TEST(PictureFile, TransparentPng_IsToldToBeComparedByItsColours) {
    ShownPicture picture = shown(2, 2, 9);
    picture.rgba8[3] = std::byte{0};
    const auto bytes = png::write(picture.view(), {.channels = png::Channels::kRgba}).value();
    EXPECT_THAT(decode(bytes, "a.png").value().warnings,
                ElementsAre("a.png has transparent pixels; only their colours are compared"));
}

TEST(PictureFile, Jpeg_IsReadByItsFirstBytes) {
    const ShownPicture picture = shown(16, 8, 128);
    encode::JpegEncoder encoder;
    const auto bytes = encoder.encode(picture.view(), {}).value();
    const auto file = decode(bytes, "a.png").value();
    const auto& read = std::get<ShownPicture>(file.picture);
    EXPECT_EQ(read.size, picture.size);
    EXPECT_NEAR(std::to_integer<int>(read.rgba8[0]), 128, 1);
}

TEST(PictureFile, RadianceFiles_KeepTheirFloats) {
    LinearImage image = light(3, 2, 0.25F);
    image.rgb[0] = 1e6F;
    image.rgb[4] = -1;
    image.rgb[17] = std::nanf("");
    for (const auto& bytes : {encode::exrOf(image).value(), encode::pfmOf(image).value()}) {
        const auto file = decode(bytes, "a").value();
        const auto& read = std::get<LinearImage>(file.picture);
        EXPECT_EQ(read.width_px, 3U);
        EXPECT_EQ(read.height_px, 2U);
        ASSERT_EQ(read.rgb.size(), image.rgb.size());
        EXPECT_TRUE(std::equal(read.rgb.begin(), read.rgb.end() - 1, image.rgb.begin()));
        EXPECT_TRUE(std::isnan(read.rgb.back()));
    }
}

// Rows go bottom-up; a positive scale says that the most significant byte comes first.
TEST(PictureFile, Pfm_OfEitherByteOrderAndGrey) {
    const auto rgb = [](const std::string& file) {
        return std::get<LinearImage>(decode(bytesOf(file), "a.pfm").value().picture).rgb;
    };
    EXPECT_THAT(rgb("Pf\n1 2\n-1.0\n" + floatsOf({1, 2})), ElementsAre(2, 2, 2, 1, 1, 1));
    EXPECT_THAT(rgb("PF 1 1 -2 " + floatsOf({1, 2, 3})), ElementsAre(2, 4, 6));
    EXPECT_THAT(rgb(std::string("Pf\n1 1\n1\n\x3f\x80\x00\x00", 14)), ElementsAre(1, 1, 1));
}

TEST(PictureFile, BrokenPfm_IsRefusedInWords) {
    EXPECT_EQ(faultOf("PF\n2 2\n-1\n" + floatsOf({1, 2})),
              "a.pic is a broken PFM file: it has 8 bytes of the 48 of 2x2 pixels");
    for (const char* sides : {"0 2", "-1 2", "2", "x y", "1e3 2", "99999999999 1"}) {
        EXPECT_THAT(faultOf("PF\n" + std::string(sides) + "\n-1\n"),
                    HasSubstr("it has no width and height"))
            << sides;
    }
    for (const char* scale : {"0", "nan", "inf", "abc", ""}) {
        EXPECT_THAT(faultOf("PF\n1 1\n" + std::string(scale) + "\n"), HasSubstr("it has no scale"))
            << scale;
    }
    // Before memory is taken for it.
    EXPECT_EQ(faultOf("PF\n4294967295 4294967295\n-1\n"),
              "a.pic has 4294967295x4294967295 pixels; at most 33177600 can be compared");
}

TEST(PictureFile, OtherFiles_AreRefusedByName) {
    EXPECT_EQ(faultOf("hello"), "a.pic is no picture that can be compared (5 bytes); expected PNG, "
                                "JPEG, OpenEXR or PFM");
    EXPECT_EQ(faultOf(""),
              "a.pic is no picture that can be compared (0 bytes); expected PNG, JPEG, "
              "OpenEXR or PFM");
    EXPECT_THAT(faultOf("\x89PNG\r\n\x1a\nxxxx"), HasSubstr("a.pic is a broken PNG file: "));
    EXPECT_THAT(faultOf("\xFF\xD8\xFF\xE0"), HasSubstr("a.pic is a broken JPEG file: "));
    EXPECT_THAT(faultOf("\x76\x2F\x31\x01"), HasSubstr("a.pic is a broken OpenEXR file: "));
    const auto absent = read("/no/such.png");
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().message, "cannot read '/no/such.png': No such file or directory");
    EXPECT_THAT(read("/tmp").error().message, HasSubstr("cannot read '/tmp': "));
}

} // namespace
} // namespace froxel::diff
