#include "load/viewer_meter.h"

#include <gtest/gtest.h>

namespace froxel::load {
namespace {

using namespace std::chrono_literals;

const TimePoint kStart = TimePoint{} + 1h;

v1::FrameHeader frame(uint64_t id, uint64_t seq, TimePoint commanded) {
    v1::FrameHeader header;
    header.set_frame_id(id);
    header.set_applied_seq(seq);
    header.set_applied_client_time_us(ViewerMeter::stampOf(commanded));
    return header;
}

const std::vector<double>& stage(const ViewerMeter& meter, Stage which) {
    return meter.measured().samples.stage_ms[static_cast<size_t>(which)];
}

TEST(ViewerMeter, Frame_ShowingANewCommand_GivesLatencyAgeAndStages) {
    ViewerMeter meter;
    meter.begin(kStart);
    v1::FrameHeader header = frame(1, 3, kStart + 10ms);
    header.set_queue_us(5'000);
    header.set_render_us(20'000);
    header.set_gpu_us(18'000);
    header.set_encode_wait_us(1'000);
    header.set_encode_us(2'000);
    header.set_send_wait_us(500);
    ASSERT_TRUE(meter.onFrame(header, 1000, 4, kStart + 50ms));
    meter.end(kStart + 2s);
    const Measured& measured = meter.measured();
    EXPECT_EQ(measured.samples.latency_ms, std::vector{40.0});
    EXPECT_EQ(measured.samples.age_ms, std::vector{35.0});
    EXPECT_EQ(stage(meter, Stage::kQueue), std::vector{5.0});
    EXPECT_EQ(stage(meter, Stage::kRender), std::vector{20.0});
    EXPECT_EQ(measured.samples.gpu_ms, std::vector{18.0});
    EXPECT_EQ(stage(meter, Stage::kNetwork), std::vector{11.5});
    EXPECT_EQ(measured.frames, 1U);
    EXPECT_EQ(measured.frame_bytes, 1000U);
    EXPECT_EQ(measured.seconds, 2.0);
}

TEST(ViewerMeter, Frame_ShowingNothingNew_CountsButHasNoLatency) {
    ViewerMeter meter;
    ASSERT_TRUE(meter.onFrame(frame(1, 2, kStart), 10, 2, kStart + 1ms)); // before measuring
    meter.begin(kStart + 2ms);
    ASSERT_TRUE(meter.onFrame(frame(2, 2, kStart), 10, 2, kStart + 5ms));
    ASSERT_TRUE(meter.onFrame(frame(5, 2, kStart), 10, 2, kStart + 12ms));
    EXPECT_EQ(meter.measured().frames, 2U);
    EXPECT_TRUE(meter.measured().samples.latency_ms.empty());
    EXPECT_TRUE(stage(meter, Stage::kQueue).empty());
    EXPECT_EQ(stage(meter, Stage::kRender).size(), 2U);
    EXPECT_EQ(meter.measured().samples.interval_ms, std::vector{7.0});
}

TEST(ViewerMeter, Reaction_IsOfEveryCommand_AlsoOvertakenOnes) {
    ViewerMeter meter;
    meter.begin(kStart);
    meter.onCommand(2, true, kStart, kStart);
    meter.onCommand(3, false, kStart, kStart + 5ms); // a Ping
    meter.onCommand(4, true, kStart, kStart + 10ms);
    meter.onCommand(5, true, kStart, kStart + 20ms);
    ASSERT_TRUE(meter.onFrame(frame(1, 4, kStart + 10ms), 10, 5, kStart + 30ms));
    EXPECT_EQ(meter.measured().samples.reaction_ms, (std::vector{30.0, 20.0}));
    EXPECT_EQ(meter.measured().samples.latency_ms, std::vector{20.0});
    ASSERT_TRUE(meter.onFrame(frame(2, 5, kStart + 20ms), 10, 5, kStart + 50ms));
    EXPECT_EQ(meter.measured().samples.reaction_ms.back(), 30.0);
    EXPECT_EQ(meter.measured().samples.reaction_ms.size(), 3U);
}

TEST(ViewerMeter, Drops_AreThoseSinceItBegan) {
    ViewerMeter meter;
    v1::FrameHeader header = frame(4, 0, kStart);
    header.set_dropped_frames(3);
    ASSERT_TRUE(meter.onFrame(header, 10, 1, kStart));
    meter.onFrameDropped();
    meter.begin(kStart);
    header.set_frame_id(9);
    header.set_dropped_frames(7);
    ASSERT_TRUE(meter.onFrame(header, 10, 1, kStart + 1ms));
    meter.onFrameDropped();
    meter.end(kStart + 1s);
    EXPECT_EQ(meter.measured().server_dropped, 4U);
    EXPECT_EQ(meter.measured().client_dropped, 1U);
}

TEST(ViewerMeter, Frame_ThatCannotBe_IsRefused) {
    ViewerMeter meter;
    meter.begin(kStart);
    EXPECT_FALSE(meter.onFrame(frame(1, 5, kStart), 10, 4, kStart + 1ms)) << "never sent";
    EXPECT_FALSE(meter.onFrame(frame(1, 2, kStart + 9ms), 10, 4, kStart + 1ms)) << "the future";
    ASSERT_TRUE(meter.onFrame(frame(7, 3, kStart), 10, 4, kStart + 1ms));
    EXPECT_FALSE(meter.onFrame(frame(7, 3, kStart), 10, 4, kStart + 2ms)) << "twice";
    EXPECT_FALSE(meter.onFrame(frame(8, 2, kStart), 10, 4, kStart + 2ms)) << "backwards";
    EXPECT_EQ(meter.measured().frames, 1U);
}

TEST(ViewerMeter, Commands_TellHowLateTheyWere_RefusalsTheirFirstText) {
    ViewerMeter meter;
    meter.begin(kStart);
    meter.onCommand(1, true, kStart, kStart + 3ms);
    meter.onCommandSkipped();
    v1::Error error;
    error.set_message("first\n");
    meter.onRefusal(error);
    error.set_message("second");
    meter.onRefusal(error);
    const Measured& measured = meter.measured();
    EXPECT_EQ(measured.samples.timer_lag_ms, std::vector{3.0});
    EXPECT_EQ(measured.commands, 1U);
    EXPECT_EQ(measured.commands_skipped, 1U);
    EXPECT_EQ(measured.refusals, 2U);
    EXPECT_EQ(measured.refusal, "first\\x0a");
}

} // namespace
} // namespace froxel::load
