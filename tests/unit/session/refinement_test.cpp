#include "session/refinement.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;
using settings::Refine;

constexpr TimePoint kStart{10s};

settings::ViewSettings view(settings::Size size = {640, 360}) {
    settings::ViewSettings settings;
    settings.size = size;
    return settings;
}

Delivery carrying(double bits_per_s) {
    Delivery delivery;
    delivery.link_rate = bits_per_s;
    return delivery;
}

class RefinementTest : public testing::Test {
  protected:
    // The stage that is due at this time; interactive where none is.
    [[nodiscard]] Refinement
    dueAt(Seconds time, Refine wanted, const Delivery& delivery = {}) const {
        const auto due = schedule_.next(wanted, delivery, view());
        const TimePoint now = kStart + std::chrono::duration_cast<Clock::duration>(time);
        return due && due->at <= now ? due->stage : Refinement::kInteractive;
    }
    RefinementSchedule schedule_;
};

TEST_F(RefinementTest, BeforeTheFirstFrame_NothingIsDue) {
    EXPECT_FALSE(schedule_.next(Refine::kLossless, {}, view()));
}

TEST_F(RefinementTest, Rest_GoesHighThenToTheMeanOfItsSamplesThenNothing) {
    for (const auto& [wanted, last] : {std::pair(Refine::kHigh, Refinement::kSmooth),
                                       std::pair(Refine::kLossless, Refinement::kLossless)}) {
        schedule_.onChange(kStart);
        schedule_.onBegun(Refinement::kInteractive, false);
        EXPECT_EQ(dueAt(149ms, wanted), Refinement::kInteractive);
        EXPECT_EQ(dueAt(151ms, wanted), Refinement::kHigh);
        schedule_.onBegun(Refinement::kHigh, false);
        EXPECT_EQ(dueAt(399ms, wanted), Refinement::kInteractive);
        for (uint32_t sample = 0; sample < settings::kMeanSamples; ++sample) {
            const auto due = schedule_.next(wanted, {}, view());
            ASSERT_TRUE(due) << sample;
            EXPECT_EQ(dueAt(401ms, wanted), last);
            EXPECT_EQ(due->sample, sample);
            EXPECT_EQ(due->sample_count, settings::kMeanSamples);
            schedule_.onBegun(last, false);
        }
        EXPECT_FALSE(schedule_.next(wanted, {}, view()));
    }
}

TEST_F(RefinementTest, DebugViewsAndHugePictures_HaveOneSample) {
    auto debug = view();
    debug.debug.view = settings::DebugView::kListedLights;
    for (const auto& settings : {debug, view({4096, 4096})}) {
        schedule_.onChange(kStart);
        schedule_.onBegun(Refinement::kHigh, false);
        EXPECT_FALSE(schedule_.next(Refine::kHigh, {}, settings));
        const auto due = schedule_.next(Refine::kLossless, {}, settings);
        ASSERT_TRUE(due);
        EXPECT_EQ(due->stage, Refinement::kLossless);
        EXPECT_EQ(due->sample_count, 1U);
        schedule_.onBegun(Refinement::kLossless, false);
        EXPECT_FALSE(schedule_.next(Refine::kLossless, {}, settings));
    }
}

TEST_F(RefinementTest, SamplesThatAreLost_BeginAnew) {
    schedule_.onChange(kStart);
    schedule_.onBegun(Refinement::kHigh, false);
    schedule_.onBegun(Refinement::kSmooth, false);
    schedule_.onBegun(Refinement::kSmooth, false);
    EXPECT_EQ(schedule_.next(Refine::kHigh, {}, view())->sample, 2U);
    schedule_.onSamplesLost();
    EXPECT_EQ(schedule_.next(Refine::kHigh, {}, view())->sample, 0U);
}

TEST_F(RefinementTest, SamplesThatAreRefused_AreNotAskedForUntilSomethingChanges) {
    schedule_.onChange(kStart);
    schedule_.onBegun(Refinement::kHigh, false);
    schedule_.onSamplesRefused();
    EXPECT_FALSE(schedule_.next(Refine::kHigh, {}, view()));
    EXPECT_EQ(schedule_.next(Refine::kLossless, {}, view())->sample_count, 1U);
    schedule_.onChange(kStart + 1s);
    EXPECT_EQ(schedule_.next(Refine::kHigh, {}, view())->sample_count, settings::kMeanSamples);
}

TEST_F(RefinementTest, Input_BeginsAnew) {
    schedule_.onChange(kStart);
    schedule_.onBegun(Refinement::kHigh, false);
    schedule_.onChange(kStart + 390ms);
    schedule_.onBegun(Refinement::kInteractive, false);
    EXPECT_EQ(dueAt(500ms, Refine::kLossless), Refinement::kInteractive);
    EXPECT_EQ(dueAt(541ms, Refine::kLossless), Refinement::kHigh);
}

TEST_F(RefinementTest, None_OnlyALimitedFrameIsMadeWhole) {
    schedule_.onChange(kStart);
    schedule_.onBegun(Refinement::kInteractive, false);
    EXPECT_FALSE(schedule_.next(Refine::kNone, {}, view()));
    schedule_.onBegun(Refinement::kInteractive, true);
    EXPECT_EQ(dueAt(151ms, Refine::kNone), Refinement::kSettled);
    schedule_.onBegun(Refinement::kSettled, false);
    EXPECT_FALSE(schedule_.next(Refine::kNone, {}, view()));
}

TEST_F(RefinementTest, SlowLink_GetsWhatItCarriesInASecond) {
    schedule_.onChange(kStart);
    schedule_.onBegun(Refinement::kInteractive, true);
    EXPECT_EQ(dueAt(1s, Refine::kLossless, carrying(0.5e6)), Refinement::kSettled);
    EXPECT_EQ(dueAt(1s, Refine::kLossless, carrying(1.5e6)), Refinement::kHigh);
    schedule_.onBegun(Refinement::kHigh, false);
    EXPECT_EQ(dueAt(1s, Refine::kLossless, carrying(1.5e6)), Refinement::kSmooth);
    EXPECT_EQ(dueAt(1s, Refine::kLossless, carrying(4e6)), Refinement::kLossless);
    // What was begun ends, whatever the link carries by then.
    schedule_.onBegun(Refinement::kLossless, false);
    EXPECT_EQ(dueAt(1s, Refine::kLossless, carrying(1.5e6)), Refinement::kLossless);
}

TEST(Delivered, Stages_AreMadeWithWhatTheyPromise) {
    Delivery limits;
    limits.scale = 0.5;
    limits.quality_max = 45;
    limits.chroma_max = settings::Chroma::k420;
    limits.rung = 6;
    const settings::Encoding asked{75, settings::Chroma::k444};
    const Delivered moving = delivered(asked, limits, Refinement::kInteractive);
    EXPECT_EQ(moving.encoding, (settings::Encoding{45, settings::Chroma::k420}));
    EXPECT_EQ(moving.scale, 0.5);
    EXPECT_EQ(moving.rung, 6U);
    const Delivered settled = delivered(asked, limits, Refinement::kSettled);
    EXPECT_EQ(settled.encoding, asked);
    EXPECT_EQ(settled.scale, 1);
    EXPECT_EQ(delivered(asked, limits, Refinement::kHigh).encoding, kRefinedEncoding);
    EXPECT_EQ(delivered({97, settings::Chroma::k420}, limits, Refinement::kHigh).encoding.quality,
              97U);
}

} // namespace
} // namespace froxel::session
