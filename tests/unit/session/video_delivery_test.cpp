// What a slow link and a resting view make of video.
#include "session/delivery.h"
#include "session/rate_ladder.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

settings::Encoding video(uint32_t kbps) {
    settings::Encoding encoding;
    encoding.codec = settings::Codec::kVp9;
    encoding.video_kbps = kbps;
    return encoding;
}

Delivery slow(double link_bits_per_s) {
    Delivery delivery;
    delivery.rung = 2;
    delivery.link_rate = link_bits_per_s;
    return delivery;
}

TEST(VideoDelivery, LinkThatIsTooSlow_BoundsTheRate) {
    EXPECT_EQ(limited(video(6000), slow(2e6)), video(1600));
    EXPECT_EQ(limited(video(1000), slow(2e6)), video(1000));
    EXPECT_EQ(limited(video(6000), slow(1000)), video(settings::kVideoKbpsRange.min));
    EXPECT_EQ(limited(video(6000), slow(1e12)), video(6000));
}

TEST(VideoDelivery, LinkThatCarriesAll_BoundsNothing) {
    Delivery delivery = slow(2e6); // the most that was seen, not the most that there is
    delivery.rung = 0;
    EXPECT_EQ(limited(video(6000), delivery), video(6000));
}

// Another size begins the stream anew by a key frame: not while the rate can still give.
TEST(VideoDelivery, Ladder_LowersTheRateBeforeTheSize_AndAsksForLessAtEachRung) {
    const auto ladder = makeLadder(video(6000));
    uint32_t kbps = 6001;
    double bits_per_s = 1e9;
    for (const Rung& rung : ladder) {
        const settings::Encoding encoding = limited(video(6000), rung.delivery);
        const Seconds interval = std::max(Seconds(1.0 / 30), rung.delivery.min_interval);
        EXPECT_EQ(encoding.quality, video(6000).quality) << "means nothing to video";
        EXPECT_TRUE(encoding.video_kbps < kbps || rung.alone) << rung.delivery.rung;
        EXPECT_TRUE(rung.delivery.scale == 1 || kbps <= 6000 * 0.35);
        EXPECT_LE(rung.bits / interval.count(), bits_per_s) << rung.delivery.rung;
        EXPECT_NEAR(rung.bits / interval.count(), encoding.video_kbps / 6000.0 * 30, 1e-6)
            << "fewer frames have more bits each";
        bits_per_s = rung.bits / interval.count();
        kbps = encoding.video_kbps;
    }
    EXPECT_EQ(ladder.back().delivery.scale, 0.5);
    EXPECT_EQ(kbps, 360U);
}

TEST(VideoDelivery, RestingView_IsRefinedByImages) {
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kInteractive).encoding.codec,
              settings::Codec::kVp9);
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kSettled).encoding, video(500));
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kHigh).encoding.codec,
              settings::Codec::kJpeg);
}

} // namespace
} // namespace froxel::session
