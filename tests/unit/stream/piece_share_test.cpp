#include "stream/piece_share.h"

#include <gtest/gtest.h>

namespace froxel::stream {
namespace {

constexpr Seconds kLimit{0.1};

TEST(PieceShare, WhatIsNotKnownBeginsFine) {
    EXPECT_LE(PieceShare(kLimit).value(), 0.25);
}

TEST(PieceShare, APieceThatTookTooLongMakesTheNextKeepTheLimit) {
    PieceShare share(kLimit);
    const double before = share.value();
    share.onPiece(kLimit * 4);
    EXPECT_DOUBLE_EQ(share.value(), before / 4);
}

TEST(PieceShare, FramesWithinTheLimitGiveAllOfItBack) {
    PieceShare share(kLimit);
    for (int frame = 0; frame < 100; ++frame) {
        share.onPiece(kLimit);
        share.onFrame();
    }
    EXPECT_EQ(share.value(), 1);
}

TEST(PieceShare, AFrameWithOneLongPieceGivesNothingBack) {
    PieceShare share(kLimit);
    share.onPiece(kLimit * 2);
    share.onPiece(kLimit / 2);
    const double after = share.value();
    share.onFrame();
    EXPECT_EQ(share.value(), after);
    share.onFrame();
    EXPECT_GT(share.value(), after);
}

TEST(PieceShare, NeverComesToNothing) {
    PieceShare share(kLimit);
    for (int piece = 0; piece < 100; ++piece) {
        share.onPiece(Seconds(100));
    }
    EXPECT_GT(share.value(), 0.01);
}

} // namespace
} // namespace froxel::stream
