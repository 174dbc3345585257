// Read again by the library that panoramas are read with.
#include "core/linear_image.h"
#include "encode/radiance_encoder.h"
#include "environment/reader.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace froxel::encode {
namespace {

LinearImage readAgain(const Picture& picture) {
    auto encoded = makeExrEncoder(1)->encode(picture.view(), {}, false, {});
    EXPECT_TRUE(encoded) << encoded.error().message;
    auto panorama = environment::read(encoded->bytes, "picture");
    EXPECT_TRUE(panorama) << panorama.error().message;
    EXPECT_TRUE(panorama->warnings.empty());
    return std::move(panorama->image);
}

class BytesIn final : public Imf::IStream {
  public:
    explicit BytesIn(std::span<const std::byte> bytes) : IStream("bytes"), bytes_(bytes) {}
    bool read(char to[], int size) override {
        std::memcpy(to, &bytes_[at_], static_cast<size_t>(size));
        at_ += static_cast<size_t>(size);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override { at_ = at; }

  private:
    std::span<const std::byte> bytes_;
    size_t at_ = 0;
};

// Empty: the file has no such channel.
std::vector<float> readZ(std::span<const std::byte> file, uint32_t width_px, uint32_t height_px) {
    BytesIn stream(file);
    Imf::InputFile input(stream, 0);
    if (input.header().channels().findChannel("Z") == nullptr) {
        return {};
    }
    std::vector<float> z(size_t{width_px} * height_px);
    Imf::FrameBuffer to;
    to.insert("Z", Imf::Slice::Make(Imf::FLOAT, z.data(), input.header().dataWindow()));
    input.setFrameBuffer(to);
    input.readPixels(0, static_cast<int>(height_px) - 1);
    return z;
}

TEST(ExrEncoder, Radiance_ComesToTheBit) {
    const Picture picture = makeRadiance(90, 45, 1);
    const LinearImage image = readAgain(picture);
    ASSERT_EQ(image.rgb.size(), size_t{90} * 45 * 3);
    size_t differing = 0;
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        differing += image.rgb[i] != picture.radiance[i / 3 * 4 + i % 3] ? 1U : 0U;
    }
    EXPECT_EQ(differing, 0U);
}

TEST(ExrEncoder, SeveralSamples_ComeAsTheirMean) {
    const Picture picture = makeRadiance(4, 2, 2);
    const LinearImage image = readAgain(picture);
    ASSERT_EQ(image.width_px, 4U);
    ASSERT_EQ(image.height_px, 2U);
    const auto sample = [&](size_t x, size_t y, size_t channel) {
        return picture.radiance[(y * 8 + x) * 4 + channel];
    };
    for (size_t y = 0; y < 2; ++y) {
        for (size_t x = 0; x < 4; ++x) {
            for (size_t channel = 0; channel < 3; ++channel) {
                const double mean =
                    0.25 *
                    (double{sample(2 * x, 2 * y, channel)} + sample(2 * x + 1, 2 * y, channel) +
                     sample(2 * x, 2 * y + 1, channel) + sample(2 * x + 1, 2 * y + 1, channel));
                EXPECT_NEAR(image.rgb[(y * 4 + x) * 3 + channel] / mean, 1, 1e-6);
            }
        }
    }
}

// The library that writes it reads it, too: channel Z is as the picture has it.
TEST(ExrEncoder, Depth_ComesAsZToTheBit) {
    Picture picture = makeRadiance(6, 3, 1);
    for (size_t i = 0; i < 18; ++i) {
        picture.depth_m.push_back(0.1F * static_cast<float>(i + 1));
    }
    picture.depth_m[4] = std::numeric_limits<float>::infinity();
    const auto encoded = makeExrEncoder(1)->encode(picture.view(), {}, false, {});
    ASSERT_TRUE(encoded) << encoded.error().message;
    EXPECT_EQ(readZ(encoded->bytes, 6, 3), picture.depth_m);
    picture.depth_m.clear();
    const auto without = makeExrEncoder(1)->encode(picture.view(), {}, false, {});
    ASSERT_TRUE(without);
    EXPECT_TRUE(readZ(without->bytes, 6, 3).empty());
}

TEST(ExrEncoder, PixelsWithoutRadiance_AreRefused) {
    const auto refused = makeExrEncoder(1)->encode(makePicture(8, 8).view(), {}, false, {});
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

} // namespace
} // namespace froxel::encode
