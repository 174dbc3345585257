#include "load/picture_check.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <vector>

namespace froxel::load {
namespace {

using Bytes = std::vector<uint8_t>;
using ::testing::HasSubstr;

// 719 high, 1281 wide.
const Bytes kJpeg = {0xFF, 0xD8, 0xFF, 0xC0, 0,    11, 8, 0x02, 0xCF, 0x05, 0x01, 1,
                     0,    0,    0,    0xFF, 0xDA, 0,  2, 1,    2,    3,    0xFF, 0xD9};
// By hand from the specification: profile 0, shown; the same size.
const Bytes kKey = {0x82, 0x49, 0x83, 0x42, 0x30, 0x50, 0x00, 0x2C, 0xE0, 0x00};
const Bytes kInter = {0x86, 0x00};

v1::FrameHeader videoFrame(bool key, uint32_t dropped_count = 0) {
    v1::FrameHeader header;
    v1::Part& part = *header.add_parts();
    part.set_codec(v1::CODEC_VP9);
    part.set_key_frame(key);
    part.set_length(static_cast<uint32_t>(key ? kKey.size() : kInter.size()));
    part.set_width(1281);
    part.set_height(719);
    header.set_dropped_frames(dropped_count);
    return header;
}

Result<void> put(PictureCheck& check, const v1::FrameHeader& header, const Bytes& bytes) {
    return check.onFrame(header, std::as_bytes(std::span(bytes)));
}

TEST(Vp9Check, KeyFrame_GivesItsSize) {
    const auto header = checkVp9(std::as_bytes(std::span(kKey))).value();
    EXPECT_TRUE(header.key);
    EXPECT_EQ(header.width_px, 1281U);
    EXPECT_EQ(header.height_px, 719U);
}

TEST(Vp9Check, CutAnywhere_IsRefused) {
    for (size_t size = 0; size + 1 < kKey.size(); ++size) {
        EXPECT_FALSE(checkVp9(std::as_bytes(std::span(kKey)).first(size))) << size;
    }
}

TEST(Vp9Check, OtherBytes_AreRefused) {
    for (const Bytes& bytes : {Bytes{0xFF, 0xD8, 0xFF, 0xC0}, Bytes{0xB2, 0, 0, 0}, Bytes{0x8A, 0},
                               Bytes{0x84, 0}, Bytes{0x82, 0x49, 0x83, 0x43, 0, 0, 0, 0, 0, 0}}) {
        EXPECT_FALSE(checkVp9(std::as_bytes(std::span(bytes))));
    }
}

TEST(PictureCheck, Video_KeyFrameAndThoseAfterIt_AreGood) {
    PictureCheck check;
    EXPECT_TRUE(put(check, videoFrame(true), kKey));
    EXPECT_TRUE(put(check, videoFrame(false), kInter));
    EXPECT_TRUE(put(check, videoFrame(true, 3), kKey));
    EXPECT_TRUE(put(check, videoFrame(false, 3), kInter));
    EXPECT_EQ(check.keyFrameCount(), 2U);
}

TEST(PictureCheck, Video_WithoutAKeyFrameOrAfterALoss_IsRefused) {
    PictureCheck check;
    EXPECT_FALSE(put(check, videoFrame(false), kInter));
    EXPECT_TRUE(put(check, videoFrame(true), kKey));
    EXPECT_THAT(put(check, videoFrame(false, 1), kInter).error().message, HasSubstr("dropped"));
}

TEST(PictureCheck, Video_FlagOrSizeDiffers_IsRefused) {
    PictureCheck check;
    v1::FrameHeader header = videoFrame(true);
    header.mutable_parts(0)->set_width(1280);
    EXPECT_THAT(put(check, header, kKey).error().message,
                HasSubstr("1281x719 for a part of 1280x"));
    header = videoFrame(true);
    header.mutable_parts(0)->set_key_frame(false);
    EXPECT_THAT(put(check, header, kKey).error().message, HasSubstr("not said to be one"));
}

TEST(PictureCheck, Jpegs_AreHeldToTheirSizes) {

    v1::FrameHeader header;
    for (const uint32_t offset : {0U, static_cast<uint32_t>(kJpeg.size())}) {
        v1::Part& part = *header.add_parts();
        part.set_offset(offset);
        part.set_length(static_cast<uint32_t>(kJpeg.size()));
        part.set_codec(v1::CODEC_JPEG);
        part.set_width(1281);
        part.set_height(719);
    }
    Bytes both = kJpeg;
    both.insert(both.end(), kJpeg.begin(), kJpeg.end());
    EXPECT_TRUE(PictureCheck().onFrame(header, std::as_bytes(std::span(both))));
    header.mutable_parts(1)->set_height(720);
    const auto wrong = PictureCheck().onFrame(header, std::as_bytes(std::span(both)));
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("1281x719 for a part of 1281x720"), std::string::npos);
}

} // namespace
} // namespace froxel::load
