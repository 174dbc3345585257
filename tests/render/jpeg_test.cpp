// JPEGs that the device makes, against TurboJPEG's: the same bytes.
#include "../unit/encode/picture.h"
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_format.h"
#include "render/view/jpeg_trial.h"
#include "support/gpu_fixture.h"

#include <algorithm>
#include <random>

namespace froxel::test {
namespace {

using encode::Picture;
using settings::Chroma;
using settings::Encoding;

Picture blank(uint32_t width_px, uint32_t height_px) {
    Picture picture{width_px, height_px, width_px * size_t{4}, {}};
    picture.bytes.assign(picture.stride_bytes * height_px, std::byte{0});
    return picture;
}

// Each byte by itself; of `extreme` ones 0 or 255, which no cosine is far from.
Picture noise(uint32_t width_px, uint32_t height_px, uint32_t seed, bool extreme) {
    Picture picture = blank(width_px, height_px);
    std::mt19937 random(seed);
    for (std::byte& byte : picture.bytes) {
        const uint32_t value = random() & 255U;
        byte = static_cast<std::byte>(!extreme ? value : value < 128 ? 0 : 255);
    }
    return picture;
}

// Blocks of the cosines themselves, as black and white: the largest coefficients that there are.
Picture cosines(uint32_t seed) {
    Picture picture = blank(64, 64);
    std::mt19937 random(seed);
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            const double across = std::cos((2 * (x % 8) + 1) * (x / 8) * M_PI / 16);
            const double down = std::cos((2 * (y % 8) + 1) * (y / 8) * M_PI / 16);
            const bool flips = random() % 64 == 0;
            const std::byte value{static_cast<uint8_t>((across * down > 0) != flips ? 255 : 0)};
            std::fill_n(&picture.bytes[y * picture.stride_bytes + x * 4], 3, value);
        }
    }
    return picture;
}

// Black and white blocks with noise in each colour: differences of DC with the longest codes, which
// begin with 1s, behind blocks that end with any bits.
Picture flips(uint32_t seed) {
    Picture picture = blank(1000, 600);
    std::mt19937 random(seed);
    for (uint32_t y = 0; y < picture.height_px; y += 8) {
        for (uint32_t x = 0; x < picture.width_px; x += 8) {
            const uint32_t grey = random() % 2 == 0 ? 0 : 224;
            for (uint32_t i = 0; i < 64 * 4; ++i) {
                picture.bytes[(y + i / 32) * picture.stride_bytes + x * 4 + i % 32] =
                    static_cast<std::byte>(grey + random() % 32);
            }
        }
    }
    return picture;
}

class DeviceJpeg : public SharedGpuTest {
  protected:
    static void SetUpTestSuite() {
        SharedGpuTest::SetUpTestSuite();
        on_ = std::make_unique<render::RenderDevice>(device());
    }
    static void TearDownTestSuite() {
        on_.reset();
        SharedGpuTest::TearDownTestSuite();
    }

    static std::vector<std::byte> make(const Picture& picture,
                                       const Encoding& encoding,
                                       const render::JpegTrialOptions& options = {}) {
        const auto format = encode::jpegFormat(encoding);
        EXPECT_TRUE(format);
        const auto trial = render::tryJpeg(*on_, picture.view(), *format, options);
        EXPECT_TRUE(trial) << trial.error().message;
        return trial->file;
    }

    static void expectSame(const Picture& picture, const Encoding& encoding, uint32_t times = 1) {
        SCOPED_TRACE(testing::Message() << picture.width_px << "x" << picture.height_px
                                        << " quality " << encoding.quality
                                        << (encoding.chroma == Chroma::k444 ? " 4:4:4" : " 4:2:0"));
        static encode::JpegEncoder turbo;
        const auto expected = turbo.encode(picture.view(), encoding);
        ASSERT_TRUE(expected) << expected.error().message;
        const auto made = make(picture, encoding, {.times = times});
        const auto at = std::ranges::mismatch(made, *expected);
        EXPECT_TRUE(made == *expected) << made.size() << " bytes for " << expected->size()
                                       << ", the first that differs is " << at.in1 - made.begin();
    }

    inline static std::unique_ptr<render::RenderDevice> on_;
};

constexpr std::array kChromas = {Chroma::k420, Chroma::k444};

TEST_F(DeviceJpeg, EveryQuality_HasTurboJpegsBytes) {
    const Picture picture = encode::makePicture(67, 45);
    for (uint32_t quality = 1; quality <= 100; ++quality) {
        for (const Chroma chroma : kChromas) {
            expectSame(picture, {.quality = quality, .chroma = chroma});
        }
    }
}

TEST_F(DeviceJpeg, EverySizeOfTheLastBlocks_HasTurboJpegsBytes) {
    for (const uint32_t height_px : {1U, 2U, 7U, 8U, 9U, 15U, 16U, 17U, 31U}) {
        for (uint32_t width_px = 1; width_px <= 34; ++width_px) {
            for (const Chroma chroma : kChromas) {
                expectSame(encode::makePicture(width_px, height_px),
                           {.quality = 85, .chroma = chroma});
            }
        }
    }
}

TEST_F(DeviceJpeg, Noise_HasTurboJpegsBytes) {
    for (const uint32_t quality : {1U, 30U, 75U, 90U, 95U, 96U, 100U}) {
        for (const Chroma chroma : kChromas) {
            const Encoding encoding{.quality = quality, .chroma = chroma};
            expectSame(noise(200, 120, quality, false), encoding);
            expectSame(noise(200, 120, quality, true), encoding);
        }
    }
}

TEST_F(DeviceJpeg, LargestCoefficients_HaveTurboJpegsBytes) {
    for (uint32_t seed = 0; seed < 4; ++seed) {
        for (const uint32_t quality : {50U, 90U, 95U, 96U, 100U}) {
            for (const Chroma chroma : kChromas) {
                expectSame(cosines(seed), {.quality = quality, .chroma = chroma});
            }
        }
    }
}

TEST_F(DeviceJpeg, LongestCodesOfDc_HaveTurboJpegsBytes) {
    for (uint32_t seed = 0; seed < 4; ++seed) {
        for (const Chroma chroma : kChromas) {
            expectSame(flips(seed), {.quality = 100, .chroma = chroma});
        }
    }
}

// A last byte that is FF once 1s fill it has a 0 stuffed behind it.
TEST_F(DeviceJpeg, AnyLastBits_HaveTurboJpegsBytes) {
    for (uint32_t seed = 0; seed < 64; ++seed) {
        expectSame(noise(8, 8, seed, false), {.quality = 100, .chroma = Chroma::k444});
    }
}

TEST_F(DeviceJpeg, LargePictures_HaveTurboJpegsBytes) {
    for (const Chroma chroma : kChromas) {
        expectSame(encode::makePicture(1280, 720), {.quality = 85, .chroma = chroma});
        expectSame(noise(1000, 1000, 1, false), {.quality = 100, .chroma = chroma});
    }
}

TEST_F(DeviceJpeg, OnePicture_IsOneBlock) {
    for (const Chroma chroma : kChromas) {
        expectSame(blank(1, 1), {.quality = 85, .chroma = chroma});
        expectSame(blank(2000, 16), {.quality = 85, .chroma = chroma}); // codes of a few bits
    }
}

TEST_F(DeviceJpeg, NextOneWithTheSameBuffers_HasTheSameBytes) {
    expectSame(noise(300, 200, 2, false), {.quality = 95}, 3);
}

TEST_F(DeviceJpeg, WhatDoesNotFit_IsNoFile) {
    const Picture picture = noise(64, 64, 3, false);
    const auto whole = make(picture, {.quality = 95});
    const auto format = encode::jpegFormat({.quality = 95});
    const auto scan_bytes = static_cast<uint32_t>(whole.size() - format->header.size());
    EXPECT_EQ(make(picture, {.quality = 95}, {.scan_bytes = scan_bytes}), whole);
    EXPECT_TRUE(make(picture, {.quality = 95}, {.scan_bytes = scan_bytes - 1}).empty());
}

} // namespace
} // namespace froxel::test
