#include "bench/stream.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

namespace froxel::bench {
namespace {

using encode::makePicture;
using settings::Chroma;

StreamError measured(uint32_t quality, Chroma chroma) {
    const auto picture = makePicture(160, 120);
    return measureStream(picture.view(), {quality, chroma}, 3).value();
}

TEST(MeasureStream, HigherQuality_IsLargerAndCloser) {
    for (const auto chroma : {Chroma::k420, Chroma::k444}) {
        StreamError last = measured(30, chroma);
        EXPECT_GT(last.perceived.flip, 0);
        for (const uint32_t quality : {65U, 95U}) {
            const StreamError error = measured(quality, chroma);
            EXPECT_GT(error.bytes, last.bytes);
            EXPECT_GT(error.shown.psnr_db, last.shown.psnr_db);
            EXPECT_LT(error.perceived.flip, last.perceived.flip);
            EXPECT_GT(error.perceived.mssim, last.perceived.mssim);
            last = error;
        }
    }
}

TEST(MeasureStream, FullChroma_IsCloser) {
    const auto halved = measured(95, Chroma::k420);
    const auto full = measured(95, Chroma::k444);
    EXPECT_GT(full.bytes, halved.bytes);
    EXPECT_LT(full.shown.rmse, halved.shown.rmse);
    EXPECT_LT(full.perceived.flip, halved.perceived.flip);
}

TEST(MeasureStream, Row_HasItsNumbers) {
    const auto row = measured(80, Chroma::k420);
    EXPECT_EQ(row.encoding, (settings::Encoding{80, Chroma::k420}));
    EXPECT_EQ(row.shown.pixel_count, 160u * 120u);
    EXPECT_DOUBLE_EQ(row.bits_per_pixel, 8.0 * static_cast<double>(row.bytes) / (160 * 120));
    EXPECT_EQ(row.encode_us.count, 3u);
    EXPECT_GT(row.encode_us.min, 0);
}

TEST(MeasureStream, EmptyPictureOrBadQuality_IsAnError) {
    EXPECT_FALSE(measureStream({}, {80, Chroma::k420}, 1));
    EXPECT_FALSE(measureStream(makePicture(8, 8).view(), {101, Chroma::k420}, 1));
}

} // namespace
} // namespace froxel::bench
