// Frames in pieces: how they come together, and who is given up.
#include "render_loop_fixture.h"

#include <chrono>
#include <thread>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

class RenderLoopPiecesTest : public RenderLoopTest {
  protected:
    void SetUp() override {
        device_->piece_count = 4;
        start();
    }
    // Joins, and waits until the first piece of its frame is on the device, which keeps it.
    session::SessionId joinAndBegin(const std::shared_ptr<RecordingSink>& sink,
                                    const session::SessionState& state) {
        device_->setGate(false);
        const auto id = join(sink, state, kPlenty);
        while (device_->submitted_count < 1) {
            std::this_thread::yield();
        }
        return id;
    }
};

TEST_F(RenderLoopPiecesTest, AllOfAFrame_MakeOnePicture) {
    const auto sink = makeSink();
    join(sink, moving(), 4);
    ASSERT_TRUE(sink->waitForFrames(4));
    settle();
    EXPECT_EQ(sink->frames().size(), 4U);
    EXPECT_EQ(device_->submitted_count, 4U * 5);
}

TEST_F(RenderLoopPiecesTest, FrameNeedsMore_IsDrawnAgain) {
    device_->again_count = 2;
    const auto sink = makeSink();
    join(sink, still(), 1);
    ASSERT_TRUE(sink->waitForFrames(1));
    settle();
    EXPECT_EQ(sink->frames().size(), 1U);
    EXPECT_EQ(device_->begun_count, 4U);
}

TEST_F(RenderLoopPiecesTest, ShadersAreBeingMade_IsAskedAgain_WhileOthersAreDrawn) {
    device_->unready_count = 3;
    const auto first = makeSink();
    join(first, still(), 1);
    ASSERT_TRUE(first->waitForFrames(1));
    settle();
    EXPECT_EQ(device_->unready_count, 0U);
    EXPECT_TRUE(first->record().compiling.empty()) << "nobody would notice";
    EXPECT_EQ(first->frames().size(), 1U);
    EXPECT_EQ(device_->begun_count, 2U); // one of them prices it
}

// They are everybody's: whoever needs them first does not wait until others have had as much time.
TEST_F(RenderLoopPiecesTest, PipelinesThatTakeLong_AreNotPaidForByTheFirst) {
    device_->unready_time = std::chrono::milliseconds(500);
    device_->unready_count = 1;
    const auto first = makeSink();
    join(first, still(), 1);
    while (device_->unready_count > 0) {
        std::this_thread::yield();
    }
    device_->frame_time = std::chrono::milliseconds(1);
    const auto other = makeSink();
    join(other, moving(), kPlenty);
    ASSERT_TRUE(first->waitForFrames(1));
    EXPECT_LT(other->frames().size(), 200U);
}

TEST_F(RenderLoopPiecesTest, ShadersThatTakeLong_AreTold_AndTheirEnd) {
    device_->unready_count = 40; // asked for each 20 ms
    const auto sink = makeSink();
    join(sink, still(), 1);
    ASSERT_TRUE(sink->waitForFrames(1));
    EXPECT_EQ(sink->record().compiling, (std::vector{true, false}));
}

TEST_F(RenderLoopPiecesTest, HostBuildsInStages_OthersAreDrawnBetween) {
    device_->stage_count = 100'000'000; // until the other one has its pictures
    const auto slow = makeSink();
    join(slow, still(), 1);
    while (device_->stage_calls < 2) {
        std::this_thread::yield();
    }
    const uint64_t before = device_->stage_calls;
    device_->small_area_px = 24 * 16; // built at once
    const auto quick = makeSink();
    auto small = moving();
    small.settings.size = {24, 16};
    join(quick, small, 3);
    ASSERT_TRUE(quick->waitForFrames(3));
    EXPECT_TRUE(slow->frames().empty());
    while (device_->stage_calls == before) { // the stages go on
        std::this_thread::yield();
    }
    device_->stage_count = 1;
    ASSERT_TRUE(slow->waitForFrames(1));
}

// The first change gives up what was built, the second one waits until that is a picture.
TEST_F(RenderLoopPiecesTest, BuiltInStages_SettingsEverChange_PicturesCome) {
    device_->stage_count = 5;
    const auto sink = makeSink();
    auto state = moving();
    std::atomic<session::SessionId> id = 0; // none yet
    std::atomic<uint32_t> count = 0;
    device_->on_stage = [&] { // on the loop's thread: no frame has two stages without a change
        if (id != 0) {
            state.settings.exposure = 1 + 0.001F * static_cast<float>(++count);
            ++state.version;
            loop_->update(id, state, Clock::now());
        }
    };
    id = join(sink, moving(), kPlenty);
    EXPECT_TRUE(sink->waitForFrames(6));
    loop_->stop(); // which stages still use
    EXPECT_GT(count, 3U);
}

// The second comes while the first piece of four is on the device.
TEST_F(RenderLoopPiecesTest, OfTwoViewers_AreMixed) {
    const auto first = makeSink();
    joinAndBegin(first, still());
    device_->piece_count = 1;
    const auto second = makeSink();
    auto other = still();
    other.settings.size = {48, 24};
    join(second, other, 1);
    device_->setGate(true);
    ASSERT_TRUE(first->waitForFrames(1));
    ASSERT_TRUE(second->waitForFrames(1));
    EXPECT_EQ(device_->done(), (std::vector<settings::Size>{{48, 24}, {32, 16}}));
}

TEST_F(RenderLoopPiecesTest, ViewerLeft_AreGivenUp) {
    const auto id = joinAndBegin(makeSink(), still());
    loop_->leave(id);
    device_->setGate(true);
    settle();
    EXPECT_EQ(device_->abandoned_count, 1U);
    EXPECT_EQ(device_->submitted_count, 1U + 4);
    EXPECT_EQ(fates_->given_up, 1U);
    loop_->stop();
    EXPECT_EQ(device_->live_views, 0);
}

TEST_F(RenderLoopPiecesTest, ViewerPaused_AreGivenUpAndDrawnOnceItGoesOn) {
    const auto sink = makeSink();
    const auto id = joinAndBegin(sink, still());
    loop_->grant(id, 0);
    device_->setGate(true);
    settle();
    EXPECT_EQ(device_->abandoned_count, 1U);
    EXPECT_TRUE(sink->frames().empty());
    loop_->grant(id, 1);
    ASSERT_TRUE(sink->waitForFrames(1));
}

TEST_F(RenderLoopPiecesTest, SomethingElseIsAskedFor_DrawsThatInstead) {
    const auto sink = makeSink();
    auto state = still();
    const auto id = joinAndBegin(sink, state);
    ++state.version;
    state.applied = {9, 99};
    loop_->update(id, state, Clock::now());
    device_->setGate(true);
    ASSERT_TRUE(sink->waitForFrames(1));
    EXPECT_EQ(sink->frames()[0].record.applied, (session::CommandStamp{9, 99}));
    EXPECT_GT(sink->frames()[0].record.queue_us, 0);
    EXPECT_EQ(device_->submitted_count, 1U + 4);
}

// A camera that never rests gets pictures too.
TEST_F(RenderLoopPiecesTest, SomethingElseIsAlwaysAskedFor_EverySecondFrameIsFinished) {
    device_->frame_time = 8ms;
    const auto sink = makeSink();
    auto state = still();
    const auto id = join(sink, state, kPlenty);
    while (sink->frames().size() < 5 || device_->abandoned_count < 1) {
        ++state.version;
        loop_->update(id, state, Clock::now());
        std::this_thread::yield();
    }
    EXPECT_LE(device_->abandoned_count, device_->begun_count / 2 + 1);
}

TEST_F(RenderLoopPiecesTest, StoppedInBetween_GivesUpTheRest) {
    joinAndBegin(makeSink(), still());
    auto stopped = std::async(std::launch::async, [this] { loop_->stop(); });
    device_->setGate(true);
    stopped.get();
    EXPECT_EQ(device_->live_views, 0);
    EXPECT_EQ(device_->live_leases, 0);
}

} // namespace
} // namespace froxel::stream
