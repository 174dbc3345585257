#include "encode/memory.h"
#include "render_loop_fixture.h"
#include "session/refinement.h"
#include "settings/samples.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

TEST_F(RenderLoopTest, Draw_StillState_IsDrawnOnce) {
    start();
    const auto sink = makeSink();
    join(sink, still(), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    settle();
    EXPECT_EQ(sink->frames().size(), 1U);
    const auto record = sink->frames()[0].record;
    EXPECT_EQ(record.frame_id, 1U);
    EXPECT_EQ(record.width_px, 32U);
    EXPECT_EQ(record.height_px, 16U);
}

TEST_F(RenderLoopTest, Draw_NewVersion_IsDrawnAgainAndEchoesTheCommand) {
    start();
    const auto sink = makeSink();
    auto state = still();
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    ++state.version;
    state.applied = {7, 1234};
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitForFrames(2));
    const auto record = sink->frames()[1].record;
    EXPECT_EQ(record.applied, (session::CommandStamp{7, 1234}));
    EXPECT_GT(record.queue_us, 0);
}

TEST_F(RenderLoopTest, Draw_MovingLightsAndCredits_StopsWhenTheyAreSpent) {
    start();
    const auto sink = makeSink();
    const auto id = join(sink, moving(), 3);
    ASSERT_TRUE(sink->waitForFrames(3));
    settle();
    EXPECT_EQ(sink->frames().size(), 3U);
    loop_->grant(id, 5);
    ASSERT_TRUE(sink->waitForFrames(5));
}

TEST_F(RenderLoopTest, Draw_NoCredit_DrawsNothing) {
    start();
    const auto sink = makeSink();
    join(sink, moving(), 0);
    settle();
    EXPECT_TRUE(sink->frames().empty());
}

TEST_F(RenderLoopTest, Draw_TwoViewers_EachGetsItsOwn) {
    start();
    const auto first = makeSink();
    const auto second = makeSink();
    join(first, moving(), kPlenty);
    auto other = moving();
    other.settings.size = {48, 24};
    join(second, other, kPlenty);
    ASSERT_TRUE(first->waitForFrames(10));
    ASSERT_TRUE(second->waitForFrames(10));
    for (const auto& frame : first->frames()) {
        ASSERT_EQ(frame.record.width_px, 32U);
    }
    for (const auto& frame : second->frames()) {
        ASSERT_EQ(frame.record.width_px, 48U);
    }
}

TEST_F(RenderLoopTest, Draw_DepthTwo_FramesStayInOrder) {
    device_->depth = 2;
    start();
    const auto sink = makeSink();
    join(sink, moving(), 50);
    ASSERT_TRUE(sink->waitForFrames(50));
    uint64_t last = 0;
    for (const auto& frame : sink->frames()) {
        ASSERT_GT(frame.record.frame_id, last);
        last = frame.record.frame_id;
    }
}

TEST_F(RenderLoopTest, Refuse_PictureDoesNotFit_TellsAndKeepsServing) {
    start();
    const auto sink = makeSink();
    auto state = moving();
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    device_->max_area_px = 1000;
    state.settings.size = {640, 480};
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    const auto refusal = sink->record().refusals[0];
    EXPECT_EQ(refusal.error.code, ErrorCode::kCapacity);
    EXPECT_EQ(refusal.refused.version, state.version);
    ASSERT_TRUE(refusal.drawn);
    EXPECT_EQ(refusal.drawn->settings.size, (settings::Size{32, 16}));

    settle();
    EXPECT_EQ(sink->record().refusals.size(), 1U) << "a refused state must not be tried again";
    const size_t before = sink->frames().size();
    state.settings.size = {32, 16};
    ++state.version;
    loop_->update(id, state, Clock::now());
    EXPECT_TRUE(sink->waitForFrames(before + 1));
}

TEST_F(RenderLoopTest, Refuse_DeviceCannot_TellsAndKeepsServing) {
    device_->computes = false;
    start();
    const auto sink = makeSink();
    auto state = still();
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    state.settings.lighting = settings::LightingStage::kCompute;
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    EXPECT_EQ(sink->record().refusals[0].error.code, ErrorCode::kUnsupported);
    state.settings.lighting = settings::LightingStage::kAuto;
    ++state.version;
    loop_->update(id, state, Clock::now());
    EXPECT_TRUE(sink->waitForFrames(2));
}

TEST_F(RenderLoopTest, Refuse_IsPacedAsAPicture) {
    device_->max_area_px = 1000;
    start(Seconds(3600));
    const auto sink = makeSink();
    auto state = still();
    state.settings.size = {640, 480};
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    for (int i = 0; i < 3; ++i) {
        ++state.version;
        loop_->update(id, state, Clock::now());
        settle();
    }
    EXPECT_EQ(device_->unfit_count, 1U);
}

TEST_F(RenderLoopTest, Refuse_ShownByTheFinishedFrame_TellsOnceAndKeepsServing) {
    device_->depth = 2;
    device_->max_lights = 2000;
    start();
    const auto sink = makeSink();
    auto state = moving();
    state.settings.lights.count = 50;
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(2));
    state.settings.lights.count = 5000;
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    settle();
    const auto record = sink->record();
    ASSERT_EQ(record.refusals.size(), 1U);
    EXPECT_EQ(record.refusals[0].error.code, ErrorCode::kCapacity);
    EXPECT_EQ(record.refusals[0].refused.version, state.version);
    ASSERT_TRUE(record.refusals[0].drawn);
    EXPECT_EQ(record.refusals[0].drawn->settings.lights.count, 50U);
    EXPECT_FALSE(record.lost);

    const size_t before = sink->frames().size();
    state.settings.lights.count = 60;
    ++state.version;
    loop_->update(id, state, Clock::now());
    EXPECT_TRUE(sink->waitForFrames(before + 3));
}

TEST_F(RenderLoopTest, Lost_WhileDrawing_TellsEveryoneAndRefusesNewcomers) {
    start();
    const auto first = makeSink();
    const auto second = makeSink();
    join(first, moving(), kPlenty);
    join(second, still(), kPlenty);
    ASSERT_TRUE(first->waitForFrames(1));
    ASSERT_TRUE(second->waitForFrames(1));
    device_->lost = true;
    const auto told = [](const auto& record) { return record.lost.has_value(); };
    EXPECT_TRUE(first->waitFor(told));
    EXPECT_TRUE(second->waitFor(told));
    EXPECT_EQ(failure_.get_future().get().code, ErrorCode::kDevice);
    EXPECT_FALSE(loop_->join(makeSink(), still(), {"a"}, Clock::now()));
}

// After a wait that ended in vain the device may still use all of it.
TEST_F(RenderLoopTest, Lost_WithPiecesOnTheDevice_WaitsNoMoreAndFreesNothing) {
    device_->depth = 2;
    start();
    const auto sinks = {makeSink(), makeSink()};
    session::SessionId last = 0;
    for (const auto& sink : sinks) {
        last = join(sink, still(), 1);
        ASSERT_TRUE(sink->waitForFrames(1));
    }
    const uint64_t collected = device_->collect_count;
    device_->setGate(false);
    device_->piece_count = 2;
    const uint64_t submitted = device_->submitted_count;
    loop_->grant(last, 2);
    auto other = still();
    ++other.version;
    loop_->update(last, other, Clock::now());
    while (device_->submitted_count < submitted + 2) {
        std::this_thread::yield();
    }
    device_->lost = true;
    device_->setGate(true);
    EXPECT_EQ(failure_.get_future().get().code, ErrorCode::kDevice);
    loop_.reset();
    for (const auto& sink : sinks) {
        EXPECT_TRUE(sink->record().lost);
    }
    EXPECT_EQ(device_->collect_count, collected + 1);
    EXPECT_EQ(device_->live_views, 2);
}

TEST_F(RenderLoopTest, PausedBeforeItsFirstPicture_TakesNoTimeFromOthers) {
    start();
    loop_->setMinRate(30, 20ms);
    const auto sink = makeSink();
    const auto id = loop_->join(sink, still(), {"a"}, Clock::now()).value();
    EXPECT_FALSE(loop_->admits({"b"}, Clock::now())) << "0.6 each";
    loop_->setTakesFrames(id, false);
    EXPECT_TRUE(loop_->admits({"b"}, Clock::now()));
}

// Two viewers keep two frames on the device: each waits for the other's, and neither costs that.
// It made what the viewer keeps, which others did when they came.
TEST_F(RenderLoopTest, FirstFrameThatTookLong_IsNotWaitedForUntilOthersHadAsMuch) {
    device_->estimate = std::chrono::milliseconds(1);
    device_->frame_time = std::chrono::milliseconds(1);
    start();
    const auto other = makeSink();
    const auto other_id = join(other, moving(), 20);
    ASSERT_TRUE(other->waitForFrames(20));
    device_->frame_time = std::chrono::milliseconds(600);
    const auto first = makeSink();
    const auto first_id = join(first, moving(), 1);
    ASSERT_TRUE(first->waitForFrames(1));
    device_->frame_time = std::chrono::milliseconds(1);
    loop_->grant(other_id, kPlenty);
    loop_->grant(first_id, 2);
    ASSERT_TRUE(first->waitForFrames(2));
    EXPECT_LT(other->frames().size(), 220U);
}

TEST_F(RenderLoopTest, FramesThatWaitForOthers_CostWhatTheyHeldTheDevice) {
    device_->depth = 2;
    device_->frame_time = 10ms;
    start();
    loop_->setMinRate(10, 10ms);
    const auto first = makeSink();
    const auto second = makeSink();
    join(first, moving(), kPlenty);
    join(second, moving(), kPlenty);
    ASSERT_TRUE(first->waitForFrames(20));
    ASSERT_TRUE(second->waitForFrames(20));
    // 0.1 each, and 0.1 for one more: 0.2 of 0.9. If a wait were charged, 0.2 each.
    EXPECT_LT(loop_->load(Clock::now()), 0.4);
}

// The price that a busy machine had at the start is not kept for ever.
TEST_F(RenderLoopTest, EverybodyLeft_TheNewcomersFrameIsPricedAgain) {
    start();
    loop_->setMinRate(1, 600ms);
    loop_->setNewcomersFrame(still().settings);
    const auto sink = makeSink();
    const auto id = loop_->join(sink, still(), {"a"}, Clock::now()).value();
    EXPECT_FALSE(loop_->admits({"b"}, Clock::now())) << "0.6 each";
    loop_->leave(id);
    while (device_->made_views == 0 || device_->live_views > 0) {
        std::this_thread::yield(); // until the measurement is over
    }
    ASSERT_TRUE(loop_->join(makeSink(), still(), {"a"}, Clock::now()));
    while (!loop_->admits({"b"}, Clock::now())) {
        std::this_thread::yield();
    }
}

TEST_F(RenderLoopTest, MakeSource_Throws_ReportsIt) {
    RenderLoopOptions options;
    options.make_source = []() -> std::unique_ptr<FrameSource> {
        throw StartupError({ErrorCode::kScene, "no such scene"});
    };
    options.on_failure = [this](const Error& error) { failure_.set_value(error); };
    const RenderLoop loop(pool_, std::move(options));
    EXPECT_EQ(failure_.get_future().get().code, ErrorCode::kScene);
}

TEST_F(RenderLoopTest, Leave_FramesUnderWay_FreesTheViewOnce) {
    start();
    for (int i = 0; i < 20; ++i) {
        const auto sink = makeSink();
        const auto id = join(sink, moving(), kPlenty);
        ASSERT_TRUE(sink->waitForFrames(1));
        loop_->leave(id);
    }
    loop_->stop();
    EXPECT_EQ(device_->live_views, 0);
    EXPECT_EQ(device_->live_leases, 0);
}

TEST_F(RenderLoopTest, Stop_DeviceBusy_WaitsForItAndCallsNoSinkAfterwards) {
    start();
    const auto sink = makeSink();
    join(sink, moving(), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    device_->setGate(false);
    auto stopped = std::async(std::launch::async, [this] { loop_->stop(); });
    device_->setGate(true);
    stopped.get();
    const size_t count = sink->frames().size();
    EXPECT_EQ(device_->live_leases, 0);
    EXPECT_EQ(sink->frames().size(), count);
    EXPECT_TRUE(loop_->join(makeSink(), still(), {"a"}, Clock::now())) << "the port still answers";
}

// Frame N is in the encoder while N + 1 is on the device.
TEST_F(RenderLoopTest, Draw_WhileEncoding_DoesNotWaitForTheEncoder) {
    start();
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    std::vector<std::byte> pixels(4);
    for (int i = 0; i < 2; ++i) { // both encoder threads
        ASSERT_TRUE(pool_.submit({PixelLease({pixels.data(), 1, 1, 4}, nullptr),
                                  {},
                                  [released](const Result<EncodedFrame>&) { released.wait(); }}));
    }
    const auto sink = makeSink();
    join(sink, moving(), kPlenty);
    while (device_->submitted_count < 2) {
        std::this_thread::yield();
    }
    EXPECT_TRUE(sink->frames().empty());
    release.set_value();
    ASSERT_TRUE(sink->waitForFrames(2));
}

bool isAt(const session::ReadyFrame& frame, session::Refinement stage) {
    return frame.record.delivered.refinement == stage;
}

TEST_F(RenderLoopTest, Rest_IsRefinedInStagesAndThenNothing) {
    for (const auto& [refine, last] :
         {std::pair(settings::Refine::kLossless, session::Refinement::kLossless),
          std::pair(settings::Refine::kHigh, session::Refinement::kSmooth)}) {
        start();
        const auto sink = makeSink();
        auto state = still();
        state.delivery.refine = refine;
        join(sink, state, 3); // no frame of the mean but the last takes a credit
        ASSERT_TRUE(sink->waitForFrames(3));
        const auto frames = sink->frames();
        EXPECT_TRUE(isAt(frames[0], session::Refinement::kInteractive));
        EXPECT_TRUE(isAt(frames[1], session::Refinement::kHigh));
        EXPECT_EQ(frames[1].record.delivered.encoding, session::kRefinedEncoding);
        EXPECT_TRUE(isAt(frames[2], last));
        EXPECT_EQ((*frames[2].bytes)[1] == std::byte{'P'}, refine == settings::Refine::kLossless);
        EXPECT_EQ(frames[2].record.frame_id, 3U);
        const Seconds apart = frames[2].ready_at - frames[0].ready_at;
        EXPECT_GE(apart, session::RefinementSchedule::kSmoothAfter / 2);
        settle();
        EXPECT_EQ(sink->frames().size(), 3U);
    }
    EXPECT_EQ(fates_->samples, 2 * (settings::kMeanSamples - 1));
}

TEST_F(RenderLoopTest, MeanOfARest_IsOfFramesThatAreSeenThroughAShiftedLens) {
    start();
    const auto sink = makeSink();
    auto state = still();
    state.settings.antialiasing = settings::Antialiasing::kFxaa;
    state.delivery.refine = settings::Refine::kHigh;
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(3));
    const auto seen = device_->begun();
    ASSERT_EQ(seen.size(), 2 + settings::kMeanSamples);
    for (uint32_t sample = 0; sample < settings::kMeanSamples; ++sample) {
        const auto& drawn = seen[2 + sample];
        EXPECT_EQ(drawn.camera,
                  settings::sampled(state.settings.camera, state.settings.size, sample));
        EXPECT_EQ(drawn.antialiasing, settings::Antialiasing::kNone);
    }
    EXPECT_EQ(seen[1].antialiasing, settings::Antialiasing::kFxaa);
    EXPECT_EQ(device_->formed_count, 2U) << "pixels are added up, not files";
}

TEST_F(RenderLoopTest, InputAmidTheSamples_IsDrawnAtOnceAndTheMeanBeginsAnew) {
    device_->frame_time = 20ms;
    start();
    const auto sink = makeSink();
    auto state = still();
    state.delivery.refine = settings::Refine::kHigh;
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(2));
    while (fates_->samples == 0) {
        std::this_thread::yield();
    }
    ++state.version;
    state.settings.exposure = 2;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitForFrames(5));
    const auto frames = sink->frames();
    EXPECT_TRUE(isAt(frames[2], session::Refinement::kInteractive));
    EXPECT_TRUE(isAt(frames[3], session::Refinement::kHigh));
    EXPECT_TRUE(isAt(frames[4], session::Refinement::kSmooth));
    EXPECT_GE(fates_->samples, settings::kMeanSamples);
}

// As long as one adds up its samples, whose memory is all that there is.
TEST_F(RenderLoopTest, ViewsThatRestTogether_AddUpAsManyAsThereIsMemoryFor) {
    means_bytes_ = 1;
    start();
    std::vector<std::shared_ptr<RecordingSink>> sinks;
    for (const float exposure : {1.0F, 2.0F, 3.0F}) {
        auto state = still();
        state.settings.exposure = exposure;
        state.delivery.refine = settings::Refine::kHigh;
        sinks.push_back(makeSink());
        join(sinks.back(), state, kPlenty);
    }
    for (const auto& sink : sinks) {
        ASSERT_TRUE(sink->waitForFrames(3));
        EXPECT_TRUE(isAt(sink->frames()[2], session::Refinement::kSmooth));
    }
    std::vector<float> of_samples; // each run of one viewer's once
    for (const auto& drawn : device_->begun()) {
        const bool sample = drawn.camera != still().settings.camera;
        if (sample && (of_samples.empty() || of_samples.back() != drawn.exposure)) {
            of_samples.push_back(drawn.exposure);
        }
    }
    EXPECT_EQ(of_samples.size(), 3U) << "none begins amid another's";
}

// A viewer that takes no more pictures gives the memory back, and begins anew when it goes on.
TEST_F(RenderLoopTest, PauseAmidTheSamples_GivesTheirMemoryToOthers) {
    means_bytes_ = 1;
    device_->frame_time = 5ms;
    start();
    const auto sink = makeSink();
    auto state = still();
    state.delivery.refine = settings::Refine::kHigh;
    const auto id = join(sink, state, 3);
    ASSERT_TRUE(sink->waitForFrames(2));
    while (fates_->samples == 0) {
        std::this_thread::yield();
    }
    loop_->grant(id, 2);
    const auto other = makeSink();
    join(other, state, kPlenty);
    ASSERT_TRUE(other->waitForFrames(3));
    EXPECT_EQ(sink->frames().size(), 2U);
    loop_->grant(id, 3);
    ASSERT_TRUE(sink->waitForFrames(3));
    EXPECT_TRUE(isAt(sink->frames()[2], session::Refinement::kSmooth));
}

TEST_F(RenderLoopTest, PictureTooLargeForItsSamples_IsNotRefused) {
    start();
    const auto sink = makeSink();
    auto state = still();
    const auto lossless =
        session::delivered(state.encoding, {}, session::Refinement::kLossless).encoding;
    device_->max_beside_bytes = std::max(encode::memoryBytes(lossless, state.settings.size),
                                         encode::memoryBytes(state.encoding, state.settings.size));
    state.delivery.refine = settings::Refine::kLossless;
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(3));
    EXPECT_TRUE(isAt(sink->frames()[2], session::Refinement::kLossless));
    EXPECT_EQ(fates_->samples, 0U);
    EXPECT_TRUE(sink->waitFor([](const auto& record) { return record.refusals.empty(); }));
}

TEST_F(RenderLoopTest, RestOfVideo_CountsTheEncoderThatIsKept) {
    start();
    const auto sink = makeSink();
    auto state = still();
    state.encoding.codec = settings::Codec::kVp9;
    state.delivery.refine = settings::Refine::kHigh;
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(2));
    ASSERT_FALSE(sink->frames()[1].isVideo());
    EXPECT_GE(device_->beside_bytes, encode::memoryBytes(state.encoding, state.settings.size));
}

TEST_F(RenderLoopTest, Delivery_LimitsMovingFramesAndMakesRestingOnesWhole) {
    start();
    const auto sink = makeSink();
    auto state = moving();
    state.encoding = {80, settings::Chroma::k444};
    state.settings.geometry_error_px = 3;
    const auto id = join(sink, state, kPlenty);
    session::Delivery limits;
    limits.scale = 0.5;
    limits.quality_max = 45;
    limits.rung = 5;
    loop_->setDelivery(id, limits);
    ASSERT_TRUE(sink->waitFor([](const auto& record) {
        return record.frames.size() > 2 && record.frames.back().record.width_px == 16;
    }));
    EXPECT_EQ(sink->frames().back().record.delivered.encoding.quality, 45U);
    EXPECT_EQ(sink->frames().back().record.delivered.rung, 5U);
    EXPECT_EQ(device_->begun().back().geometry_error_px, 1.5F) << "of the picture that is shown";
    // The lights stop: a frame below what was asked for is followed by one as asked for.
    auto stopped = still();
    stopped.encoding = state.encoding;
    stopped.version = state.version + 1;
    loop_->update(id, stopped, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) {
        return isAt(record.frames.back(), session::Refinement::kSettled);
    }));
    const auto last = sink->frames().back().record;
    EXPECT_EQ(last.width_px, 32U);
    EXPECT_EQ(last.delivered.encoding, state.encoding);
    // Resting, whole: what the link allows is no reason to draw.
    const size_t count = sink->frames().size();
    limits.quality_max = 55;
    limits.scale = 0.75;
    loop_->setDelivery(id, limits);
    settle();
    EXPECT_EQ(sink->frames().size(), count);
}

TEST_F(RenderLoopTest, TargetRate_OfAMovingViewGivesGeometryError) {
    device_->frame_time = 40ms;
    device_->detail_levels = true;
    device_->coarse_px = 1;
    start();
    const auto sink = makeSink();
    auto state = moving();
    state.delivery.target_fps = 60;
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitFor([](const auto& record) {
        return !record.frames.empty() &&
               record.frames.back().record.delivered.geometry_error_px == 1;
    }));
    EXPECT_EQ(sink->frames().back().record.width_px, 32U);
    EXPECT_EQ(sink->frames().front().record.delivered.geometry_error_px, 0);
    EXPECT_EQ(device_->begun().front().geometry_error_px, 0);
    const auto has = [&](float error_px) {
        return std::ranges::any_of(device_->begun(), [&](const auto& settings) {
            return settings.geometry_error_px == error_px;
        });
    };
    EXPECT_TRUE(has(0.5F) && has(1));
    auto stopped = still();
    stopped.delivery = state.delivery;
    stopped.version = state.version + 1;
    loop_->update(id, stopped, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) {
        return isAt(record.frames.back(), session::Refinement::kSettled);
    }));
    EXPECT_EQ(sink->frames().back().record.delivered.geometry_error_px, 0);
}

TEST_F(RenderLoopTest, Delivery_Interval_PacesMovingFrames) {
    start();
    const auto sink = makeSink();
    const auto id = join(sink, moving(), kPlenty);
    session::Delivery limits;
    limits.min_interval = Seconds(0.05);
    limits.rung = 7;
    loop_->setDelivery(id, limits);
    const auto paced = [](const session::ReadyFrame& frame) {
        return frame.record.delivered.rung == 7;
    };
    ASSERT_TRUE(sink->waitFor([&](const auto& record) {
        return std::count_if(record.frames.begin(), record.frames.end(), paced) >= 4;
    }));
    std::vector<double> times_s;
    for (const auto& frame : sink->frames()) {
        if (paced(frame)) {
            times_s.push_back(frame.record.time_s);
        }
    }
    for (size_t i = 1; i < times_s.size(); ++i) {
        EXPECT_GE(times_s[i] - times_s[i - 1], 0.049);
    }
}

} // namespace
} // namespace froxel::stream
