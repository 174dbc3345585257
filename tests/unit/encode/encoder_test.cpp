#include "encode/encoder.h"
#include "encode/memory.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

#include <chrono>

namespace froxel::encode {
namespace {

constexpr settings::Size kSize{64, 48};

class EncoderOf : public testing::TestWithParam<settings::CodecRow> {
  protected:
    [[nodiscard]] Result<EncodedPart> next() {
        at_ += std::chrono::milliseconds(33);
        return encoder_->encode(picture_.view(), {.codec = GetParam().codec}, false, at_);
    }

    const Picture picture_ = makeRadiance(kSize.width_px, kSize.height_px, 1);
    const std::unique_ptr<Encoder> encoder_ = makeEncoder(GetParam().codec, 1);
    TimePoint at_ = TimePoint() + std::chrono::hours(1);
};

TEST_P(EncoderOf, Frames_DependAsTheRowSays) {
    const auto first = next().value();
    EXPECT_FALSE(first.bytes.empty());
    EXPECT_TRUE(first.key);
    EXPECT_EQ(next().value().key, !GetParam().frames_depend);
}

TEST_P(EncoderOf, Parts_AreOneWhereFramesDepend) {
    const Picture large = makeRadiance(1280, 720, 1);
    const auto parts = encoder_->cut(large.view(), {.codec = GetParam().codec}, 4);
    EXPECT_GE(parts.size(), 1U);
    EXPECT_TRUE(parts.size() == 1 || !GetParam().frames_depend);
}

TEST_P(EncoderOf, EmptyView_IsRefused) {
    const auto refused = encoder_->encode({}, {.codec = GetParam().codec}, false, at_);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

TEST_P(EncoderOf, Memory_CountsWhatIsKept) {
    const settings::EncoderMemory& kept = GetParam().memory;
    const uint64_t plain = memoryBytes({}, kSize);
    EXPECT_EQ(memoryBytes({.codec = GetParam().codec}, kSize),
              plain + kept.base_bytes + kept.bytes_420 * kSize.width_px * kSize.height_px);
}

INSTANTIATE_TEST_SUITE_P(Codecs,
                         EncoderOf,
                         testing::ValuesIn(settings::kCodecRows),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
} // namespace froxel::encode
