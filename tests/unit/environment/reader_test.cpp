#include "environment/reader.h"
#include "unit/environment/panorama_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::environment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<ExrChannel> kRgb = {
    {"R", Imf::HALF, 1}, {"G", Imf::HALF, 20}, {"B", Imf::HALF, 300}};

void expectRefused(const std::string& file, ErrorCode code, const std::string& part) {
    const auto read = environment::read(bytesOf(file), "sky");
    ASSERT_FALSE(read) << part;
    EXPECT_EQ(read.error().code, code) << read.error().message;
    EXPECT_THAT(read.error().message, HasSubstr(part));
    EXPECT_EQ(read.error().message.rfind("sky ", 0), 0U);
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

// Every shorter file is one line, too: nothing hangs, nothing is made up.
void expectPartsRefused(const std::string& file) {
    ASSERT_TRUE(environment::read(bytesOf(file), "sky"));
    for (size_t size = 0; size < file.size(); ++size) {
        EXPECT_FALSE(environment::read(bytesOf(file.substr(0, size)), "sky"))
            << size << " of " << file.size();
    }
}

// RGBE: mantissa * 2^(exponent - 136).
const std::string kTwoPixels = {'\x80', '\x40', '\x20', '\x81', '\x80', '\x80', '\x80', '\x84'};

// A row of 8 equal pixels in run lengths: 2, 2, the width, then a run of each byte.
std::string runs(unsigned char r, unsigned char g, unsigned char b, unsigned char e) {
    std::string row = {2, 2, 0, 8};
    for (const unsigned char byte : {r, g, b, e}) {
        row += {static_cast<char>(128 + 8), static_cast<char>(byte)};
    }
    return row;
}

} // namespace

TEST(Radiance, Pixels_AreMantissaAndExponent) {
    const auto read = environment::read(bytesOf(radianceFile("-Y 1 +X 2", kTwoPixels)), "sky");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->image.width_px, 2U);
    EXPECT_EQ(read->image.height_px, 1U);
    EXPECT_THAT(read->image.rgb, ElementsAre(1, 0.5F, 0.25F, 8, 8, 8));
    EXPECT_TRUE(read->warnings.empty());
}

TEST(Radiance, RunLengths_AreUnpackedTopRowFirst) {
    std::string rows;
    for (unsigned char exponent = 0x81; exponent < 0x85; ++exponent) {
        rows += runs(0x80, 0x40, 0x20, exponent);
    }
    const auto read = environment::read(bytesOf(radianceFile("-Y 4 +X 8", rows)), "sky");
    ASSERT_TRUE(read) << read.error().message;
    for (size_t y = 0; y < 4; ++y) {
        for (size_t x = 0; x < 8; ++x) {
            const float* rgb = &read->image.rgb[(y * 8 + x) * 3];
            EXPECT_EQ(rgb[0], std::exp2(static_cast<float>(y)));
            EXPECT_EQ(rgb[1], rgb[0] / 2);
            EXPECT_EQ(rgb[2], rgb[0] / 4);
        }
    }
    expectPartsRefused(radianceFile("-Y 4 +X 8", rows));
    expectPartsRefused(radianceFile("-Y 1 +X 2", kTwoPixels));
}

TEST(Radiance, OtherFiles_AreRefused) {
    // Run lengths of old: a pixel, then (1, 1, 1, n): n more of it.
    const std::string old = {'\x80', '\x80', '\x80', '\x81', 1, 1, 1, 31};
    expectRefused(radianceFile("-Y 4 +X 8", old), ErrorCode::kIo, "before 1991");
    expectRefused(radianceFile("+Y 1 +X 2", kTwoPixels), ErrorCode::kIo, "-Y HEIGHT +X WIDTH");
    expectRefused(radianceFile("-Y 1 +X 2", kTwoPixels, "FORMAT=32-bit_rle_xyze\n"), ErrorCode::kIo,
                  "32-bit_rle_rgbe");
    expectRefused(radianceFile("-Y 2 +X 1", kTwoPixels), ErrorCode::kInvalidArgument,
                  "1x2 pixels; expected");
    expectRefused(radianceFile("-Y 5000 +X 10000", ""), ErrorCode::kCapacity, "8192x4096");
    expectRefused(radianceFile("-Y 0 +X 0", ""), ErrorCode::kInvalidArgument, "0x0");
    expectRefused("", ErrorCode::kUnsupported, "neither");
    expectRefused("\x89PNG\r\n", ErrorCode::kUnsupported, "neither");
}

TEST(Radiance, HeaderThatChangesValues_IsTold) {
    const auto read = environment::read(
        bytesOf(radianceFile("-Y 1 +X 2", kTwoPixels, "EXPOSURE=2.5\nFORMAT=32-bit_rle_rgbe\n")),
        "sky");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->warnings.size(), 1U);
    EXPECT_THAT(read->warnings[0], HasSubstr("sky has EXPOSURE=2.5"));
}

TEST(Exr, EveryLayout_HasTheSamePixels) {
    for (const bool tiled : {false, true}) {
        for (const auto compression :
             {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
              Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION}) {
            for (const auto type : {Imf::HALF, Imf::FLOAT}) {
                const std::string file =
                    exrFile({.width = 8, .height = 4, .compression = compression, .tiled = tiled},
                            {{"R", type, 1}, {"G", type, 20}, {"B", type, 300}, {"A", type, 5}});
                const auto read = environment::read(bytesOf(file), "sky");
                ASSERT_TRUE(read) << read.error().message;
                EXPECT_EQ(read->image.width_px, 8U);
                EXPECT_EQ(read->image.height_px, 4U);
                for (size_t i = 0; i < 32; ++i) {
                    const float index = static_cast<float>(i);
                    ASSERT_EQ(read->image.rgb[3 * i], 1 + index) << tiled << ' ' << compression;
                    ASSERT_EQ(read->image.rgb[3 * i + 1], 20 + index);
                    ASSERT_EQ(read->image.rgb[3 * i + 2], 300 + index);
                }
            }
        }
    }
}

TEST(Exr, LossyCompression_IsNear) {
    for (const auto compression :
         {Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        const auto read = environment::read(
            bytesOf(exrFile({.width = 8, .height = 4, .compression = compression}, kRgb)), "sky");
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_NEAR(read->image.rgb[2], 300, 15) << compression;
    }
}

TEST(Exr, LuminanceAlone_IsGrey) {
    const auto read = environment::read(
        bytesOf(exrFile({.width = 2, .height = 1}, {{"Y", Imf::FLOAT, 7}})), "sky");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->image.rgb, ElementsAre(7, 7, 7, 8, 8, 8));
}

TEST(Exr, EveryPart_IsOneLine) {
    expectPartsRefused(exrFile({}, kRgb));
    expectPartsRefused(exrFile({.compression = Imf::NO_COMPRESSION, .tiled = true}, kRgb));
}

// Not 2 GB for an attribute of a file of 400 bytes.
TEST(Exr, SizesInTheHeader_AreNotBelieved) {
    std::string file = exrFile({}, kRgb);
    const size_t size_at = file.find("string") + sizeof "string";
    for (size_t i = 0; i < 4; ++i) {
        file[size_at + i] = "\xFF\xFF\xFF\x7F"[i];
    }
    expectRefused(file, ErrorCode::kIo, "broken OpenEXR");
}

TEST(Exr, OtherLayouts_AreRefused) {
    expectRefused(exrFile({.width = 3, .height = 2}, kRgb), ErrorCode::kInvalidArgument,
                  "has 3x2 pixels; expected");
    expectRefused(exrFile({}, {{"R"}, {"G"}, {"Z"}}), ErrorCode::kUnsupported,
                  "channels G, R, Z; expected R, G and B");
    expectRefused(exrFile({}, {{"R", Imf::UINT}, {"G"}, {"B"}}), ErrorCode::kUnsupported,
                  "channel R of integers");
    expectRefused(exrFile({.parts = 2}, kRgb), ErrorCode::kUnsupported, "2 parts; expected one");
    expectRefused(exrFile({.cropped = true}, kRgb), ErrorCode::kUnsupported, "data window");
    expectRefused(exrFile({.width = 8194, .height = 4097}, {{"Y"}}), ErrorCode::kCapacity,
                  "8194x4097");
    std::vector<ExrChannel> many(100, kRgb[0]);
    for (size_t i = 0; i < many.size(); ++i) {
        many[i].name = "layer." + std::to_string(i);
    }
    expectRefused(exrFile({}, many), ErrorCode::kCapacity, "100 channels");
}

TEST(Exr, OtherPrimaries_AreTold) {
    const auto read = environment::read(bytesOf(exrFile({.wide_gamut = true}, kRgb)), "sky");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->warnings.size(), 1U);
    EXPECT_THAT(read->warnings[0], HasSubstr("primaries"));
}

TEST(Reader, ValuesThatNoLightHas_AreReplacedAndTold) {
    const float infinity = std::numeric_limits<float>::infinity();
    const auto read = environment::read(
        bytesOf(exrFile({.width = 2, .height = 1}, {{"R", Imf::FLOAT, std::nanf("")},
                                                    {"G", Imf::FLOAT, -0.5F},
                                                    {"B", Imf::HALF, infinity}})),
        "sky");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->image.rgb, ElementsAre(0, 0, 65504, 0, 0.5F, 65504));
    EXPECT_THAT(read->warnings,
                ElementsAre("sky has 2 of 6 values that are not numbers, read as 0",
                            "sky has 1 of 6 values below 0, read as 0",
                            "sky has 2 of 6 values that are infinite, read as 65504"));
}

} // namespace froxel::environment
