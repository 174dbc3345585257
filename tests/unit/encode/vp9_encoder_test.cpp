#include "encode/memory.h"
#include "encode/vp9_encoder.h"
#include "support/planes.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <malloc.h>
#include <memory>
#include <random>
#include <utility>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>

namespace froxel::encode {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint kStart = TimePoint() + 1h;
constexpr auto kFrameTime = 33ms;

settings::Encoding encoding(uint32_t kbps, settings::Chroma chroma = settings::Chroma::k420) {
    return {.chroma = chroma, .codec = settings::Codec::kVp9, .video_kbps = kbps};
}

// A pattern that moves by two pixels a frame.
Picture moving(uint32_t width_px, uint32_t height_px, uint32_t number) {
    const Picture wide = makePicture(width_px + 2 * number, height_px);
    Picture picture{width_px, height_px, width_px * size_t{4} + 8, {}};
    picture.bytes.assign(picture.stride_bytes * height_px, std::byte{0xEE});
    for (uint32_t y = 0; y < height_px; ++y) {
        std::copy_n(&wide.bytes[y * wide.stride_bytes + size_t{8} * number], width_px * size_t{4},
                    &picture.bytes[y * picture.stride_bytes]);
    }
    return picture;
}

// Makes the upper eighth new in every frame, which no prediction helps with.
void addNoise(Picture& picture, std::mt19937& random) {
    for (uint32_t y = 0; y < picture.height_px / 8; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            const auto grey = static_cast<std::byte>(96 + random() % 64);
            std::fill_n(&picture.bytes[y * picture.stride_bytes + size_t{4} * x], 3, grey);
        }
    }
}

class Decoder {
  public:
    Decoder() { EXPECT_EQ(vpx_codec_dec_init(&codec_, vpx_codec_vp9_dx(), nullptr, 0), 0); }
    ~Decoder() { vpx_codec_destroy(&codec_); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    // Null where the frame cannot be decoded, or gives no picture at once.
    const vpx_image_t* decode(const EncodedPart& frame) {
        const auto* data = reinterpret_cast<const uint8_t*>(frame.bytes.data());
        if (vpx_codec_decode(&codec_, data, static_cast<unsigned>(frame.bytes.size()), nullptr,
                             0) != VPX_CODEC_OK) {
            return nullptr;
        }
        vpx_codec_iter_t iterator = nullptr;
        return vpx_codec_get_frame(&codec_, &iterator);
    }

  private:
    vpx_codec_ctx_t codec_{};
};

// In decibels, over all three channels.
double psnr(const Picture& picture, const vpx_image_t& image) {
    const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
    const auto width = static_cast<int>(image.d_w);
    const auto height = static_cast<int>(image.d_h);
    std::vector<unsigned char> rgba(size_t{4} * image.d_w * image.d_h);
    const int subsampling = image.fmt == VPX_IMG_FMT_I444 ? TJSAMP_444 : TJSAMP_420;
    const unsigned char* planes[] = {image.planes[0], image.planes[1], image.planes[2]};
    EXPECT_EQ(tjDecodeYUVPlanes(handle.get(), planes, image.stride, subsampling, rgba.data(), width,
                                0, height, TJPF_RGBX, 0),
              0);
    double squares = 0;
    for (uint32_t y = 0; y < image.d_h; ++y) {
        for (uint32_t x = 0; x < image.d_w; ++x) {
            for (uint32_t c = 0; c < 3; ++c) {
                const int got = rgba[(size_t{y} * image.d_w + x) * 4 + c];
                squares += std::pow(got - picture.channel(x, y, c), 2);
            }
        }
    }
    return 10 * std::log10(255.0 * 255.0 * 3 * image.d_w * image.d_h / (squares + 1e-9));
}

// Frames of a moving pattern, one every kFrameTime.
class Film {
  public:
    explicit Film(uint32_t width_px = 320, uint32_t height_px = 180)
        : width_px_(width_px), height_px_(height_px) {}
    EncodedPart next(const settings::Encoding& encoding, bool key = false) {
        picture = moving(width_px_, height_px_, number_++);
        if (noisy) {
            addNoise(picture, random_);
        }
        at += kFrameTime;
        return encoder.encode(picture.view(), encoding, key, at).value();
    }

    Vp9Encoder encoder{2};
    Picture picture;
    TimePoint at = kStart;
    bool noisy = false;

  private:
    std::mt19937 random_{7};
    uint32_t width_px_;
    uint32_t height_px_;
    uint32_t number_ = 0;
};

TEST(Vp9Encoder, Frames_EachDecodesAtOnceToItsPicture) {
    for (const settings::Chroma chroma : {settings::Chroma::k420, settings::Chroma::k444}) {
        Film film(161, 99);
        Decoder decoder;
        for (int i = 0; i < 10; ++i) {
            const EncodedPart frame = film.next(encoding(20'000, chroma));
            EXPECT_EQ(frame.key, i == 0);
            const vpx_image_t* image = decoder.decode(frame);
            ASSERT_NE(image, nullptr) << i;
            EXPECT_EQ(image->d_w, 161U);
            EXPECT_EQ(image->d_h, 99U);
            EXPECT_EQ(image->range, VPX_CR_FULL_RANGE);
            EXPECT_EQ(image->cs, VPX_CS_BT_601);
            EXPECT_GT(psnr(film.picture, *image), chroma == settings::Chroma::k444 ? 30 : 22) << i;
        }
    }
}

TEST(Vp9Encoder, SmallestAndOddSizes_AreEncoded) {
    for (const settings::Size size : {settings::Size{16, 16}, {17, 33}, {1, 1}, {4096, 16}}) {
        Film film(size.width_px, size.height_px);
        Decoder decoder;
        for (int i = 0; i < 3; ++i) {
            EXPECT_NE(decoder.decode(film.next(encoding(1000))), nullptr) << size.width_px;
        }
    }
}

// A device may have made them: in rows of any length, and none of the sizes even.
TEST(Vp9Encoder, Planes_GiveTheFramesOfTheirPixels) {
    for (const auto chroma : {settings::Chroma::k420, settings::Chroma::k444}) {
        for (const auto& [width_px, height_px] : {std::pair(320U, 180U), {33U, 17U}}) {
            Vp9Encoder of_pixels{1};
            Vp9Encoder of_planes{1};
            TimePoint at = kStart;
            for (uint32_t number = 0; number < 4; ++number) {
                const Picture picture = moving(width_px, height_px, number);
                PixelView view = picture.view();
                const auto expected =
                    of_pixels.encode(view, encoding(1000, chroma), false, at += kFrameTime);
                PlaneView planes;
                const auto kept = test::planesOf(view, chroma, 7, planes);
                view.planes = planes;
                view.data = nullptr;
                view.stride_bytes = 0;
                const auto made = of_planes.encode(view, encoding(1000, chroma), false, at);
                ASSERT_TRUE(expected && made);
                EXPECT_EQ(made->bytes, expected->bytes);
                EXPECT_EQ(made->key, expected->key);
            }
        }
    }
}

TEST(Vp9Encoder, KeyAskedFor_OnlyThatFrameIsOne) {
    Film film;
    EXPECT_TRUE(film.next(encoding(2000)).key);
    EXPECT_FALSE(film.next(encoding(2000)).key);
    EXPECT_TRUE(film.next(encoding(2000), true).key);
    const EncodedPart after = film.next(encoding(2000));
    EXPECT_FALSE(after.key);
}

TEST(Vp9Encoder, KeyFrame_StandsAlone) {
    Film film;
    for (int i = 0; i < 5; ++i) {
        (void)film.next(encoding(4000));
    }
    Decoder late;
    EXPECT_EQ(late.decode(film.next(encoding(4000))), nullptr) << "refers to what it never saw";
    const vpx_image_t* image = late.decode(film.next(encoding(4000), true));
    ASSERT_NE(image, nullptr);
    EXPECT_GT(psnr(film.picture, *image), 15);
    EXPECT_NE(late.decode(film.next(encoding(4000))), nullptr);
}

TEST(Vp9Encoder, SizeOrChromaChanges_GivesAKeyFrame) {
    Vp9Encoder encoder(1);
    const Picture small = makePicture(64, 48);
    const Picture large = makePicture(65, 48);
    auto encode = [&, at = kStart](const Picture& picture, settings::Chroma chroma) mutable {
        at += kFrameTime;
        return encoder.encode(picture.view(), encoding(1000, chroma), false, at).value().key;
    };
    EXPECT_TRUE(encode(small, settings::Chroma::k420));
    EXPECT_FALSE(encode(small, settings::Chroma::k420));
    EXPECT_TRUE(encode(large, settings::Chroma::k420));
    EXPECT_TRUE(encode(large, settings::Chroma::k444));
    EXPECT_FALSE(encode(large, settings::Chroma::k444));
    EXPECT_TRUE(encode(large, settings::Chroma::k420));
    EXPECT_FALSE(encode(large, settings::Chroma::k420));
}

TEST(Vp9Encoder, Rate_IsHeldAndFollowsWithoutAKeyFrame) {
    Film film;
    film.noisy = true;
    EXPECT_TRUE(film.next(encoding(500)).key);
    const auto kbpsOf = [&](uint32_t kbps) {
        constexpr int kSettling = 30;
        constexpr int kCounted = 60;
        size_t bytes = 0;
        for (int i = 0; i < kSettling + kCounted; ++i) {
            const EncodedPart frame = film.next(encoding(kbps));
            EXPECT_FALSE(frame.key);
            bytes += i < kSettling ? 0 : frame.bytes.size();
        }
        return static_cast<double>(bytes) * 8 / (kCounted * Seconds(kFrameTime).count() * 1000);
    };
    EXPECT_NEAR(kbpsOf(500), 500, 100);
    EXPECT_NEAR(kbpsOf(1000), 1000, 200);
    EXPECT_NEAR(kbpsOf(500), 500, 100);
}

TEST(Vp9Encoder, AfterAPause_AFrameIsThatOfATenthOfASecond) {
    const auto after = [](Seconds pause) {
        Film film;
        film.noisy = true;
        for (int i = 0; i < 60; ++i) {
            (void)film.next(encoding(400));
        }
        film.at += std::chrono::duration_cast<Clock::duration>(pause) - kFrameTime;
        return film.next(encoding(400)).bytes;
    };
    const auto of_a_tenth = after(100ms);
    ASSERT_FALSE(of_a_tenth.empty());
    for (const Seconds pause : {Seconds(1), Seconds(5), Seconds(3600)}) {
        EXPECT_EQ(after(pause), of_a_tenth) << pause.count();
    }
}

// Bytes of twelve frames, and the worst of their PSNR.
std::pair<size_t, double> recorded(uint32_t level) {
    Vp9Encoder encoder(2, ConstantQuality{level});
    Decoder decoder;
    size_t bytes = 0;
    double worst = 1e9;
    for (uint32_t i = 0; i < 12; ++i) {
        const Picture picture = moving(161, 99, i);
        // No rate counts: 1 kbit/s would leave nothing of it.
        const auto frame = encoder
                               .encode(picture.view(), encoding(100, settings::Chroma::k444),
                                       i % 5 == 0, kStart + i * kFrameTime)
                               .value();
        EXPECT_EQ(frame.key, i % 5 == 0) << i;
        bytes += frame.bytes.size();
        const vpx_image_t* image = decoder.decode(frame);
        EXPECT_NE(image, nullptr) << i;
        if (image != nullptr) {
            worst = std::min(worst, psnr(picture, *image));
        }
    }
    return {bytes, worst};
}

TEST(Vp9Encoder, ConstantQuality_HoldsForEveryFrame_WhateverTheBitsItTakes) {
    const auto [best_bytes, best] = recorded(0);
    const auto [usual_bytes, usual] = recorded(20);
    const auto [worst_bytes, worst] = recorded(63);
    EXPECT_GT(best, 40);
    EXPECT_GT(usual, 33);
    EXPECT_GT(best, usual + 3);
    EXPECT_GT(usual, worst + 3);
    EXPECT_GT(best_bytes, usual_bytes);
    EXPECT_GT(usual_bytes, worst_bytes);
}

TEST(Vp9Encoder, WhatCannotBeEncoded_IsRefusedAndStartsAnew) {
    Vp9Encoder encoder(1);
    const Picture picture = makePicture(64, 48);
    EXPECT_TRUE(encoder.encode(picture.view(), encoding(1000), false, kStart).value().key);
    PixelView narrow = picture.view();
    narrow.stride_bytes = 64;
    for (const PixelView& pixels : {PixelView{}, narrow}) {
        const auto refused = encoder.encode(pixels, encoding(1000), false, kStart + 1s);
        EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    }
    const auto slow = encoder.encode(picture.view(), encoding(99), false, kStart + 2s);
    EXPECT_EQ(slow.error().message, "video_kbps is 99; it must be from 100 to 100000");
    EXPECT_TRUE(encoder.encode(picture.view(), encoding(1000), false, kStart + 3s).value().key);
}

// By what the allocator has handed out, which libvpx and its threads go through.
TEST(VideoMemory, OfAnySize_IsNoMoreThanIsSaid) {
    for (const auto chroma : {settings::Chroma::k420, settings::Chroma::k444}) {
        for (const settings::Size size :
             {settings::Size{64, 64}, {640, 360}, {1280, 720}, {1920, 1080}}) {
            const auto used = [] {
                const auto heap = mallinfo2();
                return heap.uordblks + heap.hblkhd;
            };
            const Picture picture = makePicture(size.width_px, size.height_px);
            const size_t before = used();
            Vp9Encoder encoder(4);
            for (int i = 0; i < 3; ++i) {
                ASSERT_TRUE(encoder.encode(picture.view(), encoding(4000, chroma), false,
                                           kStart + i * kFrameTime));
            }
            EXPECT_LE(used() - before, memoryBytes(encoding(4000, chroma), size))
                << size.width_px << "x" << size.height_px;
        }
    }
}

} // namespace
} // namespace froxel::encode
