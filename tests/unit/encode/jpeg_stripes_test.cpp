#include "encode/encode_pool.h"
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_stripes.h"
#include "unit/encode/decoded.h"
#include "unit/encode/picture.h"

#include <future>

namespace froxel::encode {
namespace {

using settings::Chroma;

std::vector<std::vector<std::byte>> encodeStripes(const std::vector<PixelView>& stripes,
                                                  const settings::Encoding& encoding) {
    std::vector<std::vector<std::byte>> parts;
    JpegEncoder encoder;
    for (const PixelView& stripe : stripes) {
        parts.push_back(encoder.encode(stripe, encoding).value());
    }
    return parts;
}

TEST(JpegStripes, Cut_CoversThePictureInWholeBlocks) {
    const Picture picture = makePicture(1283, 719, 4);
    for (const auto chroma : {Chroma::k420, Chroma::k444}) {
        for (const size_t wanted : {1U, 2U, 3U, 4U, 100U}) {
            const auto stripes = cutStripes(picture.view(), chroma, wanted);
            EXPECT_LE(stripes.size(), wanted);
            const std::byte* next = picture.bytes.data();
            uint32_t rows = 0;
            for (const PixelView& stripe : stripes) {
                EXPECT_EQ(stripe.data, next);
                EXPECT_EQ(rows % (chroma == Chroma::k420 ? 16U : 8U), 0U);
                EXPECT_EQ(stripe.width_px, 1283U);
                rows += stripe.height_px;
                next += size_t{stripe.height_px} * stripe.stride_bytes;
            }
            EXPECT_EQ(rows, 719U);
        }
    }
}

TEST(JpegStripes, Cut_SmallPicture_StaysWhole) {
    const Picture picture = makePicture(320, 180);
    EXPECT_EQ(cutStripes(picture.view(), Chroma::k420, 8).size(), 1U);
    EXPECT_EQ(cutStripes({}, Chroma::k420, 8).size(), 1U);
}

TEST(JpegStripes, Joined_AnySizeAndCount_DecodesToTheSamePixels) {
    for (const auto& [width, height] : {std::pair{1280U, 720U}, {1001U, 777U}, {4096U, 517U}}) {
        const Picture picture = makePicture(width, height);
        for (const settings::Encoding encoding :
             {settings::Encoding{80, Chroma::k420}, {95, Chroma::k444}, {5, Chroma::k420}}) {
            const auto whole = decode(JpegEncoder().encode(picture.view(), encoding).value());
            for (const size_t wanted : {2U, 5U, 20U}) {
                const auto stripes = cutStripes(picture.view(), encoding.chroma, wanted);
                ASSERT_GT(stripes.size(), 1U);
                const auto joined = joinStripes(encodeStripes(stripes, encoding), height).value();
                const auto back = decode(joined);
                EXPECT_EQ(back.width, whole.width);
                EXPECT_EQ(back.height, whole.height);
                EXPECT_EQ(back.subsampling, whole.subsampling);
                EXPECT_TRUE(back.rgb == whole.rgb)
                    << width << "x" << height << " in " << stripes.size() << " stripes, quality "
                    << encoding.quality;
            }
        }
    }
}

// Two stripes would have 131,072 coded units each, more than a restart interval may.
TEST(JpegStripes, LargestPicture_KeepsToTheFormatsInterval) {
    const Picture picture = makePicture(4096, 4096);
    const settings::Encoding encoding{20, Chroma::k444};
    const auto stripes = cutStripes(picture.view(), encoding.chroma, 2);
    EXPECT_GT(stripes.size(), 2U);
    const auto joined = joinStripes(encodeStripes(stripes, encoding), 4096).value();
    EXPECT_TRUE(decode(joined).rgb ==
                decode(JpegEncoder().encode(picture.view(), encoding).value()).rgb);
}

TEST(JpegStripes, NoJpeg_IsAnError) {
    const std::vector<std::vector<std::byte>> empty(2);
    EXPECT_FALSE(joinStripes(empty, 720));
    auto cut = encodeStripes({makePicture(64, 64).view()}, {80, Chroma::k420});
    for (const size_t size : {3U, 20U, 100U, 400U}) {
        auto part = cut;
        part[0].resize(size);
        EXPECT_FALSE(joinStripes(part, 64)) << size << " bytes";
    }
}

TEST(JpegStripes, Pool_IdleThreads_ShareOnePicture) {
    const Picture picture = makePicture(1280, 720);
    const settings::Encoding encoding{80, Chroma::k420};
    const auto whole = decode(JpegEncoder().encode(picture.view(), encoding).value());
    EncodePool pool(4, 4);
    bool shared = false;
    // How many threads are idle at its turn is the system's choice: after some pictures all have
    // started.
    for (int i = 0; i < 1000 && !shared; ++i) {
        std::promise<Result<EncodedFrame>> promise;
        ASSERT_TRUE(pool.submit({{picture.view(), [] {}}, encoding, [&](Result<EncodedFrame> done) {
                                     promise.set_value(done);
                                 }}));
        const EncodedFrame frame = promise.get_future().get().value();
        EXPECT_EQ(frame.height_px, 720U);
        ASSERT_TRUE(decode(*frame.bytes).rgb == whole.rgb);
        shared = frame.bytes->size() != JpegEncoder().encode(picture.view(), encoding)->size();
    }
    EXPECT_TRUE(shared);
}

} // namespace
} // namespace froxel::encode
