#include "stream/device_pace.h"

#include <gtest/gtest.h>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

TEST(DevicePace, FramesAsExpected_LeaveIt) {
    DevicePace pace;
    for (int i = 0; i < 100; ++i) {
        pace.onFrame(100ms, 100ms, 1s);
    }
    EXPECT_EQ(pace.value(), 1);
}

// A server that started beside a compiler.
TEST(DevicePace, DeviceThatWasMeasuredTooSlow_IsKnownAfterSomeFrames) {
    DevicePace pace;
    for (int i = 0; i < 10; ++i) {
        pace.onFrame(950ms, 50ms, 1s);
    }
    EXPECT_LT(pace.value(), 1.2 * 50 / 950);
    EXPECT_GT(pace.value(), 49.0 / 950);
}

TEST(DevicePace, OneSlowFrame_IsHardlyHeard) {
    DevicePace pace;
    pace.onFrame(100ms, 5s, 1s);
    EXPECT_LT(pace.value(), 1.2);
    for (int i = 0; i < 5; ++i) {
        pace.onFrame(100ms, 100ms, 1s);
    }
    EXPECT_LT(pace.value(), 1.05);
}

TEST(DevicePace, DeviceThatIsSlowerFromNowOn_IsKnownToo) {
    DevicePace pace;
    for (int i = 0; i < 50; ++i) {
        pace.onFrame(100ms, 200ms, 1s);
    }
    EXPECT_NEAR(pace.value(), 2, 0.05);
}

// What every frame takes besides would count for too much.
TEST(DevicePace, SmallFrames_TellNothing) {
    DevicePace pace;
    for (int i = 0; i < 50; ++i) {
        pace.onFrame(50us, 300us, 1s);
        pace.onFrame(0s, 300ms, 1s);
    }
    EXPECT_EQ(pace.value(), 1);
}

} // namespace
} // namespace froxel::stream
