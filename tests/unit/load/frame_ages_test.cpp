#include "load/frame_ages.h"

#include <gtest/gtest.h>

#include <limits>

namespace froxel::load {
namespace {

using namespace std::chrono_literals;

const TimePoint kStart = TimePoint{} + 1h;

// Drawn when the lights' clock showed `time_s`, and 10 ms on the server.
v1::FrameHeader drawnAt(double time_s) {
    v1::FrameHeader header;
    header.set_time_s(time_s);
    header.set_render_us(6'000);
    header.set_encode_wait_us(1'000);
    header.set_encode_us(2'000);
    header.set_send_wait_us(1'000);
    return header;
}

void expectAges(const FrameAges& ages, const std::vector<double>& expected_ms) {
    const auto ages_ms = ages.all();
    ASSERT_EQ(ages_ms.size(), expected_ms.size());
    for (size_t index = 0; index < ages_ms.size(); ++index) {
        EXPECT_NEAR(ages_ms[index], expected_ms[index], 1e-3) << index;
    }
}

TEST(FrameAges, NoCommand_IsByTheClock_AgainstTheFastestFrame) {
    FrameAges ages(1);
    ages.onFrame(drawnAt(5.0), kStart + 300ms, {}); // 290 ms later on its way than the next one
    ages.onFrame(drawnAt(6.0), kStart + 1010ms, {});
    expectAges(ages, {300, 10});
}

TEST(FrameAges, SomeCommands_SetTheClock) {
    FrameAges ages(1);
    ages.onFrame(drawnAt(5.0), kStart + 50ms, 30.0);
    ages.onFrame(drawnAt(5.1), kStart + 150ms, 45.0); // with a longer way up
    ages.onFrame(drawnAt(5.2), kStart + 290ms, {});
    expectAges(ages, {30, 45, 70});
}

TEST(FrameAges, Clock_OfAnotherRate_IsTakenIntoAccount) {
    FrameAges ages(0.5);
    ages.onFrame(drawnAt(5.0), kStart, {});
    ages.onFrame(drawnAt(5.5), kStart + 1040ms, {});
    expectAges(ages, {10, 50});
}

TEST(FrameAges, Clock_StandingOrNone_LeavesTheStages) {
    FrameAges ages;
    ages.onFrame(drawnAt(5), kStart, {});
    ages.onFrame(drawnAt(5), kStart + 3s, {});
    expectAges(ages, {10, 10});
    FrameAges senseless(1);
    senseless.onFrame(drawnAt(std::numeric_limits<double>::quiet_NaN()), kStart, {});
    senseless.onFrame(drawnAt(1e308), kStart, {});
    expectAges(senseless, {10, 10});
}

TEST(FrameAges, Clock_Set_IsTrustedUntilThen) {
    FrameAges ages(1);
    ages.onFrame(drawnAt(5), kStart, {});
    ages.onFrame(drawnAt(6), kStart + 1200ms, {});
    ages.forgetClock();
    ages.onFrame(drawnAt(1000), kStart + 2s, {});
    expectAges(ages, {10, 210, 10});
}

} // namespace
} // namespace froxel::load
