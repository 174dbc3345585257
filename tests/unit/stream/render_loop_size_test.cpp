// Pictures that would take longer than one may.

#include "render_loop_fixture.h"

namespace froxel::stream {
namespace {

constexpr settings::Size kAsked{640, 360};

class RenderLoopSize : public RenderLoopTest {
  protected:
    // What is drawn in half the time that a picture of kAsked takes is as long as one may.
    void beSlow() { device_->slow_area_px = uint64_t{kAsked.width_px} * kAsked.height_px / 2; }
    session::SessionState asks(session::SessionState state) {
        state.settings.size = kAsked;
        return state;
    }
};

TEST_F(RenderLoopSize, FirstPictureTakesTooLong_IsDrawnSmaller) {
    beSlow();
    device_->frame_time = std::chrono::milliseconds(1);
    start();
    const auto sink = makeSink();
    join(sink, asks(still()), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto record = sink->frames()[0].record;
    EXPECT_LT(record.width_px, kAsked.width_px * 3 / 4);
    EXPECT_GT(record.width_px, kAsked.width_px / 2);
    EXPECT_GT(record.full_size_us, 2000) << "what all of it would take is told";
    EXPECT_TRUE(sink->record().refusals.empty());
}

TEST_F(RenderLoopSize, LaterPictureTakesTooLong_IsDrawnSmallerToo_AndGrowsBack) {
    start();
    const auto sink = makeSink();
    auto state = asks(moving());
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    EXPECT_EQ(sink->frames()[0].record.width_px, kAsked.width_px);
    EXPECT_EQ(sink->frames()[0].record.full_size_us, 0);
    const auto shows = [&](auto is_there) {
        return sink->waitFor([is_there](const auto& record) {
            return !record.frames.empty() && is_there(record.frames.back().record);
        });
    };
    beSlow();
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(shows([](const auto& record) { return record.width_px < kAsked.width_px; }));
    device_->slow_area_px = uint64_t{1} << 40U;
    loop_->grant(id, 2 * kPlenty);
    EXPECT_TRUE(shows([](const auto& record) {
        return record.width_px == kAsked.width_px && record.full_size_us == 0;
    }));
    EXPECT_TRUE(sink->record().refusals.empty());
}

// Its lights stand, so nothing else asks for another picture.
TEST_F(RenderLoopSize, ViewThatRests_GrowsByItself) {
    beSlow();
    device_->frame_time = std::chrono::milliseconds(1);
    device_->estimate = std::chrono::milliseconds(10);
    start();
    const auto sink = makeSink();
    join(sink, asks(still()), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    EXPECT_LT(sink->frames()[0].record.width_px, kAsked.width_px);
    device_->slow_area_px = uint64_t{1} << 40U;
    EXPECT_TRUE(sink->waitFor([](const auto& record) {
        return record.frames.back().record.width_px == kAsked.width_px;
    }));
}

// Stills say what would fit.
TEST_F(RenderLoopSize, PictureBesideTheSessions_IsRefused) {
    beSlow();
    start();
    const auto sink = makeSink();
    const auto id = loop_->joinBeside(sink, asks(still())).value();
    loop_->grant(id, 1);
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    const auto refusal = sink->record().refusals[0];
    EXPECT_EQ(refusal.error.code, ErrorCode::kTooLong);
    EXPECT_NEAR(refusal.error.too_large_by, 2, 0.01);
}

TEST_F(RenderLoopSize, PictureThatMemoryDoesNotHold_IsRefused) {
    device_->max_area_px = 1000;
    start();
    const auto sink = makeSink();
    join(sink, asks(still()), kPlenty);
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    EXPECT_EQ(sink->record().refusals[0].error.code, ErrorCode::kCapacity);
}

} // namespace
} // namespace froxel::stream
