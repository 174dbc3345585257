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

v1::ClientMessage camera() {
    v1::ClientMessage message;
    message.mutable_set_camera();
    return message;
}

v1::ViewState movingLights() {
    v1::ViewState state;
    state.set_light_count(100);
    state.set_light_speed(1);
    return state;
}

v1::ViewState restingLights() {
    v1::ViewState state = movingLights();
    state.set_light_time_s(7);
    return state;
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
    EXPECT_EQ(measured.samples.queue_ms, std::vector{5.0});
    EXPECT_EQ(measured.samples.render_ms, std::vector{20.0});
    EXPECT_EQ(measured.samples.gpu_ms, std::vector{18.0});
    EXPECT_EQ(measured.samples.network_ms, std::vector{11.5});
    EXPECT_EQ(measured.frames, 1U);
    EXPECT_EQ(measured.frame_bytes, 1000U);
    EXPECT_EQ(measured.seconds, 2.0);
}

TEST(ViewerMeter, Frame_WithoutATimeOnTheDevice_HasNoSampleOfIt) {
    ViewerMeter meter;
    meter.begin(kStart);
    ASSERT_TRUE(meter.onFrame(frame(1, 3, kStart), 10, 4, kStart + 50ms));
    EXPECT_TRUE(meter.measured().samples.gpu_ms.empty());
    EXPECT_EQ(meter.measured().samples.render_ms.size(), 1U);
}

TEST(ViewerMeter, Frame_ShowingNothingNew_CountsButHasNoLatency) {
    ViewerMeter meter;
    ASSERT_TRUE(meter.onFrame(frame(1, 2, kStart), 10, 2, kStart + 1ms)); // before measuring
    meter.begin(kStart + 2ms);
    ASSERT_TRUE(meter.onFrame(frame(2, 2, kStart), 10, 2, kStart + 5ms));
    ASSERT_TRUE(meter.onFrame(frame(5, 2, kStart), 10, 2, kStart + 12ms));
    EXPECT_EQ(meter.measured().frames, 2U);
    EXPECT_TRUE(meter.measured().samples.latency_ms.empty());
    EXPECT_TRUE(meter.measured().samples.queue_ms.empty());
    EXPECT_EQ(meter.measured().samples.render_ms.size(), 2U);
    EXPECT_TRUE(meter.measured().samples.interval_ms.empty()) << "none was due";
}

TEST(ViewerMeter, Reaction_IsOfEveryCommand_AlsoOvertakenOnes) {
    ViewerMeter meter;
    meter.begin(kStart);
    v1::ClientMessage ping;
    ping.mutable_ping();
    meter.onCommand(2, camera(), kStart, kStart);
    meter.onCommand(3, ping, kStart, kStart + 5ms);
    meter.onCommand(4, camera(), kStart, kStart + 10ms);
    meter.onCommand(5, camera(), kStart, kStart + 20ms);
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
    meter.onCommand(1, camera(), kStart, kStart + 3ms);
    meter.onCommandSkipped(2, kStart);
    v1::Error error;
    error.set_message("first\n");
    error.set_code(v1::ERROR_CODE_CAPACITY);
    meter.onError(error);
    error.set_message("second");
    error.set_code(v1::ERROR_CODE_DEVICE);
    meter.onError(error);
    const Measured& measured = meter.measured();
    EXPECT_EQ(measured.samples.timer_lag_ms, std::vector{3.0});
    EXPECT_EQ(measured.commands, 1U);
    EXPECT_EQ(measured.commands_skipped, 1U);
    EXPECT_EQ(measured.errors_by_code,
              (std::map<v1::ErrorCode, uint64_t>{{v1::ERROR_CODE_CAPACITY, 1},
                                                 {v1::ERROR_CODE_DEVICE, 1}}));
    EXPECT_EQ(measured.first_error, "first\\x0a");
}

TEST(ViewerMeter, Begin_WhileLightsMove_IsWhereTheFirstIntervalBegins) {
    ViewerMeter meter;
    meter.onState(movingLights(), kStart - 1s);
    meter.begin(kStart);
    ASSERT_TRUE(meter.onFrame(frame(1, 0, kStart), 10, 0, kStart + 900ms));
    ASSERT_TRUE(meter.onFrame(frame(2, 0, kStart), 10, 0, kStart + 950ms));
    meter.end(kStart + 1s);
    EXPECT_EQ(meter.measured().samples.interval_ms, (std::vector{900.0, 50.0, 50.0}));
}

TEST(ViewerMeter, End_DuringAStall_CountsTheWaitOfFrameAndCommands) {
    ViewerMeter meter;
    meter.onState(restingLights(), kStart);
    meter.begin(kStart);
    meter.onCommand(1, camera(), kStart, kStart);
    ASSERT_TRUE(meter.onFrame(frame(1, 1, kStart), 10, 1, kStart + 10ms));
    meter.onCommand(2, camera(), kStart, kStart + 1s);
    meter.onCommand(3, camera(), kStart, kStart + 2s);
    meter.end(kStart + 21s);
    const Measured& measured = meter.measured();
    EXPECT_EQ(measured.commands_unshown, 2U);
    EXPECT_EQ(measured.samples.reaction_ms, (std::vector{10.0, 20'000.0, 19'000.0}));
    EXPECT_EQ(measured.samples.interval_ms, (std::vector{10.0, 20'000.0}))
        << "from the first command that waited: before it nothing was due";
}

TEST(ViewerMeter, Script_ThatNeverRests_MakesFramesDueOfAWatcherToo) {
    ViewerMeter meter;
    meter.onState(restingLights(), kStart);
    meter.begin(kStart, /*restless=*/true);
    meter.end(kStart + 3s);
    EXPECT_EQ(meter.measured().samples.interval_ms, std::vector{3000.0});
}

TEST(ViewerMeter, Idle_WhileLightsRest_HasNothingDue) {
    ViewerMeter meter;
    meter.onState(restingLights(), kStart);
    meter.begin(kStart);
    meter.end(kStart + 30s);
    EXPECT_TRUE(meter.measured().samples.interval_ms.empty());
    EXPECT_EQ(meter.measured().commands_unshown, 0U);
}

TEST(ViewerMeter, Lights_ThatBeginToMove_MakeFramesDueFromThenOn) {
    ViewerMeter meter;
    meter.onState(restingLights(), kStart);
    meter.begin(kStart);
    meter.onState(movingLights(), kStart + 5s);
    meter.end(kStart + 7s);
    EXPECT_EQ(meter.measured().samples.interval_ms, std::vector{2000.0});
}

v1::ClientMessage selection(const std::string& scene) {
    v1::ClientMessage message;
    message.mutable_select_scene()->set_scene(scene);
    return message;
}

TEST(ViewerMeter, SceneCalledOff_IsWaitedForNoMore) {
    ViewerMeter meter;
    meter.onScene("hall");
    meter.onState(restingLights(), kStart);
    meter.begin(kStart);
    meter.onCommand(4, selection("fox"), kStart, kStart);
    meter.onCommand(5, selection("hall"), kStart + 200ms, kStart + 200ms);
    meter.end(kStart + 3s);
    EXPECT_TRUE(meter.measured().samples.interval_ms.empty());
    EXPECT_EQ(meter.measured().commands_unshown, 0U);
}

TEST(ViewerMeter, SceneThatCame_IsWaitedForUntilAFrameShowsIt) {
    ViewerMeter meter;
    meter.onScene("hall");
    meter.onState(restingLights(), kStart);
    meter.begin(kStart);
    meter.onCommand(4, selection("fox"), kStart, kStart);
    meter.onScene("fox");
    meter.onCommand(5, selection("fox"), kStart + 100ms, kStart + 100ms);
    ASSERT_TRUE(meter.onFrame(frame(1, 4, kStart), 10, 5, kStart + 500ms));
    meter.end(kStart + 3s);
    EXPECT_EQ(meter.measured().samples.interval_ms, std::vector{500.0});
}

TEST(ViewerMeter, Camera_Skipped_ReactsWithTheNextCommandShown) {
    ViewerMeter meter;
    meter.begin(kStart);
    meter.onCommandSkipped(4, kStart + 10ms);
    meter.onCommand(4, camera(), kStart + 20ms, kStart + 20ms);
    ASSERT_TRUE(meter.onFrame(frame(1, 4, kStart + 20ms), 10, 4, kStart + 50ms));
    EXPECT_EQ(meter.measured().samples.reaction_ms, (std::vector{40.0, 30.0}));
}

TEST(ViewerMeter, Command_Refused_WaitsNoMore) {
    ViewerMeter meter;
    meter.begin(kStart);
    meter.onCommand(3, camera(), kStart, kStart);
    v1::Error error;
    error.set_ref_seq(3);
    meter.onError(error);
    meter.end(kStart + 9s);
    EXPECT_EQ(meter.measured().commands_unshown, 0U);
    EXPECT_TRUE(meter.measured().samples.interval_ms.empty());
}

TEST(ViewerMeter, Pause_UntilItEnds_MakesNothingDue) {
    ViewerMeter meter;
    meter.onState(movingLights(), kStart);
    meter.begin(kStart);
    v1::ClientMessage pause;
    pause.mutable_pause()->set_paused(true);
    meter.onCommand(1, pause, kStart, kStart);
    meter.onCommand(2, camera(), kStart, kStart + 1s);
    pause.mutable_pause()->set_paused(false);
    meter.onCommand(3, pause, kStart, kStart + 5s);
    ASSERT_TRUE(meter.onFrame(frame(1, 2, kStart + 1s), 10, 3, kStart + 5s + 20ms));
    EXPECT_EQ(meter.measured().samples.interval_ms, std::vector{20.0});
    EXPECT_TRUE(meter.measured().samples.reaction_ms.empty());
}

// A watcher of a room: no command, and a clock that is 3 s off.
TEST(ViewerMeter, TakeNew_OverTime_AddsUpToWhatTheEndHas) {
    ViewerMeter meter;
    EXPECT_EQ(meter.takeNew(kStart - 1s).seconds, 0) << "it has not begun";
    meter.begin(kStart);
    meter.onCommand(1, camera(), kStart, kStart + 1ms);
    ASSERT_TRUE(meter.onFrame(frame(1, 1, kStart + 1ms), 100, 1, kStart + 11ms));
    Measured sum = meter.takeNew(kStart + 1s);
    EXPECT_EQ(sum.frames, 1U);
    EXPECT_EQ(sum.seconds, 1);
    EXPECT_EQ(sum.samples.latency_ms, std::vector{10.0});
    meter.onCommand(2, camera(), kStart + 1s, kStart + 1s);
    EXPECT_EQ(meter.waiting(kStart + 1500ms).reaction_ms, std::vector{500.0});
    meter.onFrameDropped();
    meter.end(kStart + 2s);
    const Measured rest = meter.takeNew(kStart + 3s);
    EXPECT_EQ(rest.frames, 0U);
    EXPECT_EQ(rest.client_dropped, 1U);
    EXPECT_EQ(rest.seconds, 1) << "no longer than it measured";
    EXPECT_TRUE(rest.samples.latency_ms.empty());
    sum.add(rest);
    EXPECT_EQ(sum.commands, 2U);
    EXPECT_EQ(sum.commands_unshown, 1U);
    for (const SampleSeries& series : kSampleSeries) {
        EXPECT_EQ(sum.samples.*series.samples, meter.measured().samples.*series.samples)
            << series.name;
    }
    EXPECT_EQ(meter.takeNew(kStart + 4s).commands, 0U) << "all was taken";
}

TEST(ViewerMeter, Watcher_HasAnAgeForEveryFrame) {
    ViewerMeter meter;
    meter.onState(movingLights(), kStart);
    meter.begin(kStart);
    v1::FrameHeader header = frame(1, 0, kStart);
    header.set_render_us(8'000);
    header.set_time_s(3.1);
    ASSERT_TRUE(meter.onFrame(header, 10, 0, kStart + 110ms));
    header.set_frame_id(2);
    header.set_time_s(3.2);
    ASSERT_TRUE(meter.onFrame(header, 10, 0, kStart + 450ms)); // 240 ms later on its way
    meter.end(kStart + 1s);
    const auto& ages_ms = meter.measured().samples.age_ms;
    ASSERT_EQ(ages_ms.size(), 2U);
    EXPECT_NEAR(ages_ms[0], 8, 1e-3);
    EXPECT_NEAR(ages_ms[1], 248, 1e-3);
}

TEST(ViewerMeter, Pictures_SmallestAndLargest_AreKept) {
    ViewerMeter meter;
    meter.begin(kStart);
    uint64_t id = 0;
    for (const uint32_t width : {640U, 256U, 320U}) {
        v1::FrameHeader header = frame(++id, 0, kStart);
        header.set_width(width);
        header.set_height(100);
        ASSERT_TRUE(meter.onFrame(header, 10, 0, kStart + 1ms));
    }
    EXPECT_EQ(meter.measured().smallest, (PictureSize{256, 100}));
    EXPECT_EQ(meter.measured().largest, (PictureSize{640, 100}));
}

} // namespace
} // namespace froxel::load
