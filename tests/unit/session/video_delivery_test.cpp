// What a slow link and a resting view make of video.
#include "session/delivery.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

view::Encoding video(uint32_t kbps) {
    view::Encoding encoding;
    encoding.codec = view::Codec::kVp9;
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
    EXPECT_EQ(limited(video(6000), slow(1000)), video(view::kVideoKbpsRange.min));
    EXPECT_EQ(limited(video(6000), slow(1e12)), video(6000));
}

TEST(VideoDelivery, LinkThatCarriesAll_BoundsNothing) {
    Delivery delivery = slow(2e6); // the most that was seen, not the most that there is
    delivery.rung = 0;
    EXPECT_EQ(limited(video(6000), delivery), video(6000));
}

TEST(VideoDelivery, RestingView_IsRefinedByImages) {
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kInteractive).encoding.codec,
              view::Codec::kVp9);
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kSettled).encoding, video(500));
    EXPECT_EQ(delivered(video(500), slow(1e6), Refinement::kHigh).encoding.codec,
              view::Codec::kJpeg);
}

} // namespace
} // namespace froxel::session
