#include "load/jpeg_check.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::load {
namespace {

using Bytes = std::vector<uint8_t>;

Bytes join(std::initializer_list<Bytes> parts) {
    Bytes all;
    for (const Bytes& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

const Bytes kStart = {0xFF, 0xD8};
const Bytes kEnd = {0xFF, 0xD9};
const Bytes kTables = {0xFF, 0xC4, 0, 3, 7}; // DHT, which lies among the frame headers' markers
// 719 high, 1281 wide.
const Bytes kFrame = {0xFF, 0xC0, 0, 11, 8, 0x02, 0xCF, 0x05, 0x01, 1, 0, 0, 0};
const Bytes kScan = {0xFF, 0xDA, 0, 2, 1, 2, 3};

Result<JpegSize> check(const Bytes& bytes) {
    return checkJpeg(std::as_bytes(std::span(bytes)));
}

TEST(JpegCheck, Whole_GivesItsSize) {
    EXPECT_EQ(check(join({kStart, kTables, kFrame, kScan, kEnd})).value(), (JpegSize{1281, 719}));
}

TEST(JpegCheck, CutAnywhere_IsRefused) {
    const Bytes whole = join({kStart, kTables, kFrame, kScan, kEnd});
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(check({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}))
            << size;
    }
}

TEST(JpegCheck, Missing_IsNamed) {
    const auto reason = [](const Bytes& bytes) { return check(bytes).error().message; };
    EXPECT_NE(reason(join({kFrame, kScan, kEnd})).find("start of image"), std::string::npos);
    EXPECT_NE(reason(join({kStart, kFrame, kScan})).find("end of image"), std::string::npos);
    EXPECT_NE(reason(join({kStart, kScan, kEnd})).find("before any frame"), std::string::npos);
    EXPECT_NE(reason(join({kStart, kFrame, kEnd})).find("no scan"), std::string::npos);
}

TEST(JpegCheck, Segment_LyingAboutItsLength_IsRefused) {
    for (const Bytes& segment : {Bytes{0xFF, 0xC0, 0, 0}, Bytes{0xFF, 0xC0, 0, 3, 8},
                                 Bytes{0xFF, 0xE0, 0xFF, 0xFF, 1}, Bytes{0x12, 0x34, 0, 2}}) {
        EXPECT_FALSE(check(join({kStart, segment, kFrame, kScan, kEnd})));
    }
}

} // namespace
} // namespace froxel::load
