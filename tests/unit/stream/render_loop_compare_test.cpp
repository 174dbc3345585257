#include "jpeg/reader.h"
#include "render_loop_fixture.h"
#include "unit/session/context.h"

#include <cstdlib>
#include <vector>

namespace froxel::stream {
namespace {

class RenderLoopCompareTest : public RenderLoopTest {
  protected:
    // The left side by clustered_deferred, the right one by naive: two shades of grey.
    session::SessionState compared(session::SessionState state) {
        state.settings.renderer = settings::Renderer::kClusteredDeferred;
        state.delivery.refine = settings::Refine::kNone;
        state.comparison = session::Comparison{session::parseRight("renderer:naive").value()};
        return state;
    }
    // A row's first grey.
    static int greyAt(const session::ReadyFrame& frame, uint32_t row) {
        const auto size = jpeg::readSize(*frame.bytes).value();
        std::vector<std::byte> rgba8(size.pixelCount() * 4);
        EXPECT_TRUE(jpeg::readPixels(*frame.bytes, rgba8));
        return std::to_integer<int>(rgba8[size_t{4} * size.width_px * row]);
    }
    // Pictures of one side each that the device was given.
    std::vector<settings::Renderer> renderers() {
        std::vector<settings::Renderer> all;
        for (const auto& settings : device_->begun()) {
            if (settings.size == settings::Size{32, 16}) {
                all.push_back(settings.renderer);
            }
        }
        return all;
    }
};

TEST_F(RenderLoopCompareTest, BothSides_AreOnePictureOneAboveTheOther) {
    start();
    const auto sink = makeSink();
    join(sink, compared(still()), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto frame = sink->frames()[0];
    EXPECT_EQ(frame.record.frame_id, 1U);
    EXPECT_EQ(frame.record.width_px, 32U);
    EXPECT_EQ(frame.record.height_px, 16U);
    EXPECT_EQ(frame.record.encodedHeight(), 32U);
    const auto size = jpeg::readSize(*frame.bytes).value();
    EXPECT_EQ(size, (PictureSize{32, 32}));
    EXPECT_GT(std::abs(greyAt(frame, 0) - greyAt(frame, 16)), 20) << "two shades";
    ASSERT_TRUE(frame.record.compared);
    EXPECT_EQ(frame.record.compared->differing_count, 512U);
    EXPECT_NEAR(frame.record.compared->max_abs, 60 / 255.0, 0.01);
    EXPECT_NEAR(frame.record.compared->rmse, frame.record.compared->max_abs, 1e-6);
    ASSERT_TRUE(frame.record.compared->first);
    EXPECT_EQ(frame.record.compared->first->x, 0U);
    EXPECT_EQ(renderers(),
              (std::vector{settings::Renderer::kClusteredDeferred, settings::Renderer::kNaive}));
    EXPECT_EQ(device_->formed_count, 0U) << "the host makes one picture of both";
    EXPECT_EQ(device_->live_views, 2);
}

TEST_F(RenderLoopCompareTest, MovingView_DrawsSidesInTurn_AndEachPictureTakesOneCredit) {
    for (const uint32_t depth : {1U, 2U}) {
        device_ = std::make_shared<test::FakeDevice>();
        device_->depth = depth;
        device_->piece_count = 2;
        start();
        const auto sink = makeSink();
        const auto id = join(sink, compared(moving()), 20);
        ASSERT_TRUE(sink->waitForFrames(20));
        settle();
        EXPECT_EQ(sink->frames().size(), 20U);
        uint64_t number = 0;
        for (const auto& frame : sink->frames()) {
            EXPECT_EQ(frame.record.frame_id, ++number);
            EXPECT_TRUE(frame.record.compared);
        }
        const auto all = renderers();
        ASSERT_GE(all.size(), 40U);
        for (size_t i = 0; i < 40; ++i) {
            EXPECT_EQ(all[i], i % 2 == 0 ? settings::Renderer::kClusteredDeferred
                                         : settings::Renderer::kNaive);
        }
        loop_->leave(id);
        loop_->stop();
        EXPECT_EQ(device_->live_leases, 0);
    }
}

// A camera that never rests: the right side is drawn as the left one was.
TEST_F(RenderLoopCompareTest, StateChangesBetweenTheSides_BothShowTheSame) {
    device_->piece_count = 3;
    start();
    const auto sink = makeSink();
    auto state = compared(moving());
    const auto id = join(sink, state, kPlenty);
    for (uint32_t i = 0; i < 200; ++i) {
        state.settings.camera.eye_world.x += 1;
        ++state.version;
        loop_->update(id, state, Clock::now());
    }
    ASSERT_TRUE(sink->waitForFrames(30));
    loop_->leave(id);
    loop_->stop();
    const auto begun = device_->begun();
    for (size_t i = 0; i < begun.size(); ++i) {
        if (begun[i].renderer == settings::Renderer::kNaive) {
            ASSERT_GT(i, 0U);
            EXPECT_EQ(begun[i].camera, begun[i - 1].camera);
        }
    }
}

TEST_F(RenderLoopCompareTest, EndOfTheComparison_FreesTheRightSidesView) {
    start();
    const auto sink = makeSink();
    auto state = compared(moving());
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(3));
    EXPECT_EQ(device_->live_views, 2);
    state.comparison.reset();
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitFor([&](const auto& record) {
        return !record.frames.back().record.compared && device_->live_views == 1;
    }));
}

TEST_F(RenderLoopCompareTest, SidesThatTakeTooLong_AreDrawnSmaller_BothAlike) {
    device_->slow_area_px = 700; // a picture of 512 pixels fits, two do not
    start();
    const auto sink = makeSink();
    join(sink, compared(still()), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto record = sink->frames()[0].record;
    EXPECT_LE(record.width_px * record.height_px, 350U);
    EXPECT_TRUE(record.compared);
}

TEST_F(RenderLoopCompareTest, RightSideThatTheDeviceCannotDraw_IsRefused_AndTheLeftGoesOn) {
    device_->computes = false;
    start();
    const auto sink = makeSink();
    auto state = still();
    const auto id = join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    state.comparison = session::Comparison{session::parseRight("lighting:compute").value()};
    ++state.version;
    loop_->update(id, state, Clock::now());
    ASSERT_TRUE(sink->waitFor([](const auto& record) { return !record.refusals.empty(); }));
    const auto refusal = sink->record().refusals[0];
    EXPECT_EQ(refusal.error.code, ErrorCode::kUnsupported);
    ASSERT_TRUE(refusal.drawn);
    EXPECT_FALSE(refusal.drawn->comparison);
    state.comparison.reset();
    ++state.version;
    loop_->update(id, state, Clock::now());
    EXPECT_TRUE(sink->waitForFrames(2));
}

TEST_F(RenderLoopCompareTest, FrameThatNeedsMore_DrawsBothSidesAgain) {
    device_->again_count = 1;
    start();
    const auto sink = makeSink();
    join(sink, compared(still()), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    EXPECT_TRUE(sink->frames()[0].record.compared);
}

TEST_F(RenderLoopCompareTest, HeatMap_IsOnePicture) {
    start();
    const auto sink = makeSink();
    auto state = compared(still());
    state.comparison->show = session::CompareShow::kHeatMap;
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto frame = sink->frames()[0];
    EXPECT_EQ(jpeg::readSize(*frame.bytes).value(), (PictureSize{32, 16}));
    EXPECT_FALSE(frame.record.compared->layered);
    EXPECT_GT(frame.record.compared->flip.value_or(0), 0.1);
}

// Of a still: left of the divider one side, right of it the other, and FLIP is measured.
TEST_F(RenderLoopCompareTest, Divided_IsOnePictureOfBoth) {
    start();
    const auto sink = makeSink();
    auto state = compared(still());
    state.comparison->divided = true;
    state.compare_split = 0.5;
    state.encoding.codec = settings::Codec::kPng;
    state.decodable.set();
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto record = sink->frames()[0].record;
    EXPECT_EQ(record.encodedHeight(), 16U);
    EXPECT_TRUE(record.compared->flip);
}

// Each side is shown as its JPEG comes out of a decoder.
TEST_F(RenderLoopCompareTest, Quality_DiffersByWhatTheCodecLoses) {
    device_->noisy = true;
    start();
    const auto sink = makeSink();
    auto state = compared(still());
    state.comparison->right = session::parseRight("quality:5").value();
    join(sink, state, kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto record = sink->frames()[0].record;
    EXPECT_GT(record.compared->differing_count, 400U);
    EXPECT_GT(record.compared->rmse, 0.02);
}

} // namespace
} // namespace froxel::stream
