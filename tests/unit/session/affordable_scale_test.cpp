#include "session/affordable_scale.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

// Of the longest that a picture may take, where one of full size takes so many times as long.
double share(double full, double scale) {
    return full * scale * scale;
}

TEST(AffordableScale, PictureThatFits_IsOfFullSize) {
    AffordableScale scale;
    scale.onEstimate(0.9, 1);
    EXPECT_EQ(scale.scale(), 1);
    EXPECT_FALSE(scale.onTook(0.9, 1));
}

TEST(AffordableScale, TooLong_IsSmallerByItsArea) {
    AffordableScale scale;
    ASSERT_TRUE(scale.onTooLong(4, false));
    EXPECT_LT(share(4, scale.scale()), 1);
    EXPECT_GT(share(4, scale.scale()), 0.7);
}

TEST(AffordableScale, EstimateThatBecomesLess_LetsItGrow) {
    AffordableScale scale;
    ASSERT_TRUE(scale.onTooLong(10, true));
    double full = 10;
    int frames = 0;
    while (scale.scale() < 1 && frames < 30) { // the device is ten times as fast as was measured
        const double drawn = scale.scale();
        scale.onEstimate(share(full, drawn), drawn);
        EXPECT_TRUE(scale.onTook(share(1.0 / 2, drawn), drawn)) << "a view that rests goes on";
        full = std::max(0.5, full * 0.7);
        ++frames;
    }
    EXPECT_EQ(scale.scale(), 1);
    EXPECT_LT(frames, 12);
}

TEST(AffordableScale, StaysWhereItsEstimateFits) {
    AffordableScale scale;
    ASSERT_TRUE(scale.onTooLong(4, false));
    const double drawn = scale.scale();
    scale.onEstimate(share(4, drawn), drawn);
    EXPECT_EQ(scale.scale(), drawn);
    EXPECT_FALSE(scale.onTook(share(4, drawn), drawn));
}

// Its estimate may never come down to what it takes.
TEST(AffordableScale, ViewThatRests_IsNotDrawnForEver) {
    AffordableScale scale;
    ASSERT_TRUE(scale.onTooLong(4, false));
    int again = 0;
    while (again < 100 && scale.onTook(0.01, scale.scale())) {
        ++again;
    }
    EXPECT_LT(again, 20);
}

TEST(AffordableScale, FirstPictureOfWhatIsTooMuchAtAnySize_TakesWhatItTakes) {
    AffordableScale scale;
    int tries = 0;
    double fixed = 30; // times the limit, whatever its size
    while (fixed > scale.limitShare() && scale.onTooLong(fixed / scale.limitShare(), true)) {
        ASSERT_LT(++tries, 10);
    }
    EXPECT_EQ(scale.scale(), AffordableScale::kLeast);
    EXPECT_GT(scale.limitShare(), fixed);
    EXPECT_FALSE(scale.onTooLong(1.5, false)) << "what comes later keeps to that";
}

// A loop that nothing cuts is as long in any picture.
TEST(AffordableScale, WhereSizeDoesNotMatter_IsNotTriedAgain) {
    AffordableScale scale;
    EXPECT_FALSE(scale.onTooLong(0, true));
    EXPECT_EQ(scale.scale(), 1);
}

TEST(AffordableScale, WithoutMemoryForMore_StaysAtWhatWasDrawn) {
    AffordableScale scale;
    ASSERT_TRUE(scale.onTooLong(100, true));
    const double drawn = scale.scale();
    scale.onEstimate(0.1, drawn);
    ASSERT_GT(scale.scale(), drawn);
    EXPECT_TRUE(scale.onNoRoom(drawn));
    EXPECT_EQ(scale.scale(), drawn);
    EXPECT_FALSE(scale.onNoRoom(drawn)) << "there was room for that";
    scale.onEstimate(0.1, drawn);
    EXPECT_EQ(scale.scale(), drawn);
    EXPECT_FALSE(scale.onTook(0.1, drawn)) << "another picture would be no larger";
    scale.forgetRoom();
    scale.onEstimate(0.1, drawn);
    EXPECT_GT(scale.scale(), drawn);
}

} // namespace
} // namespace froxel::session
