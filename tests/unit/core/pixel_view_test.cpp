#include "core/pixel_view.h"

#include <gtest/gtest.h>

namespace froxel {
namespace {

struct Counted {
    int ended = 0;
    PixelLease lease(uint32_t width_px = 4) {
        return {PixelView{nullptr, width_px, 1, 16}, [this] { ++ended; }};
    }
};

TEST(PixelLease, LeavingScope_EndsItOnce) {
    Counted counted;
    {
        const PixelLease lease = counted.lease();
        EXPECT_EQ(lease.view().width_px, 4U);
        EXPECT_EQ(counted.ended, 0);
    }
    EXPECT_EQ(counted.ended, 1);
}

TEST(PixelLease, End_IsIdempotentAndClearsTheView) {
    Counted counted;
    PixelLease lease = counted.lease();
    lease.end();
    lease.end();
    EXPECT_EQ(counted.ended, 1);
    EXPECT_EQ(lease.view().width_px, 0U);
}

TEST(PixelLease, Move_HandsTheClaimOver) {
    Counted counted;
    {
        PixelLease first = counted.lease();
        const PixelLease second = std::move(first);
        EXPECT_EQ(second.view().width_px, 4U);
        first.end(); // a moved-from lease claims nothing
        EXPECT_EQ(counted.ended, 0);
    }
    EXPECT_EQ(counted.ended, 1);
}

TEST(PixelLease, MoveAssignment_EndsTheOldClaimFirst) {
    Counted old_slot;
    Counted new_slot;
    PixelLease lease = old_slot.lease();
    lease = new_slot.lease(9);
    EXPECT_EQ(old_slot.ended, 1);
    EXPECT_EQ(new_slot.ended, 0);
    EXPECT_EQ(lease.view().width_px, 9U);
}

} // namespace
} // namespace froxel
