#include "stream/frame_pipeline.h"
#include "support/recording_sink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <latch>
#include <span>
#include <thread>
#include <vector>

namespace froxel::stream {
namespace {

constexpr uint32_t kSide = 16;

class FramePipelineTest : public testing::Test {
  protected:
    DrawnFrame frame(uint64_t id) {
        return frameOf(id, {pixels_.data(), kSide, kSide, size_t{4} * kSide});
    }
    // Of which the device made a file; empty: it does not fit.
    DrawnFrame file(uint64_t id, std::span<const std::byte> bytes) {
        return frameOf(id, {.width_px = kSide, .height_px = kSide, .jpeg = bytes});
    }
    DrawnFrame frameOf(uint64_t id, const PixelView& view) {
        DrawnFrame drawn;
        drawn.pixels = PixelLease(view, [this] { ++ended_leases_; });
        drawn.record.frame_id = id;
        drawn.drawn_at = Clock::now();
        return drawn;
    }
    DrawnFrame video(uint64_t id, uint64_t key_requests = 0) {
        DrawnFrame drawn = frame(id);
        drawn.record.delivered.encoding.codec = settings::Codec::kVp9;
        drawn.key_requests = key_requests;
        return drawn;
    }
    // What arrived, in order: 'j' a JPEG, 'K' a key frame, 'd' another frame of video.
    std::string kinds() {
        std::string text;
        for (const auto& ready : sink_->frames()) {
            const auto& record = ready.record;
            text += record.delivered.encoding.codec == settings::Codec::kJpeg ? 'j'
                    : record.key                                              ? 'K'
                                                                              : 'd';
        }
        return text;
    }
    void waitForProgress(int count) {
        for (int seen = progress_; seen < count; seen = progress_) {
            progress_.wait(seen);
        }
    }
    // Another viewer's job, which does not end before the latch opens.
    void occupy(encode::EncodePool& pool, std::latch& release, bool lossless = false) {
        encode::EncodeJob job{
            PixelLease({pixels_.data(), kSide, kSide, size_t{4} * kSide}, nullptr),
            {.codec = lossless ? settings::kLosslessCodec : settings::kPlainCodec},
            [&](const Result<EncodedFrame>&) { release.wait(); }};
        while (!pool.submit(std::move(job))) {
            std::this_thread::yield(); // the thread has not taken the job before this one yet
        }
    }
    std::shared_ptr<FramePipeline> makePipeline(encode::EncodePool& pool) {
        return std::make_shared<FramePipeline>(pool, 7, sink_, fates_, [this] {
            ++progress_;
            progress_.notify_all();
        });
    }

    std::array<std::byte, size_t{4} * kSide * kSide> pixels_{};
    std::atomic<int> ended_leases_ = 0;
    std::atomic<int> progress_ = 0;
    std::shared_ptr<FrameFates> fates_ = std::make_shared<FrameFates>();
    std::shared_ptr<test::RecordingSink> sink_ = std::make_shared<test::RecordingSink>();
};

TEST_F(FramePipelineTest, Push_TwoFrames_ArriveInOrderAndEndTheirLeases) {
    encode::EncodePool pool(2, 4);
    const auto pipeline = makePipeline(pool);
    pipeline->push(frame(1));
    pipeline->push(frame(2));
    ASSERT_TRUE(sink_->waitForFrames(2));
    const auto frames = sink_->frames();
    EXPECT_EQ(frames[0].record.frame_id, 1U);
    EXPECT_EQ(frames[1].record.frame_id, 2U);
    EXPECT_EQ(frames[0].record.encoded_bytes, frames[0].bytes->size());
    EXPECT_EQ(fates_->encoded, 2U);
    EXPECT_GT(pipeline->takeWork(), Seconds(0));
    EXPECT_EQ(pipeline->takeWork(), Seconds(0));
    EXPECT_EQ(fates_->not_encoded, 0U);
    EXPECT_EQ(ended_leases_, 2);
}

TEST_F(FramePipelineTest, Push_FileOfTheDevice_LeavesAsItIs) {
    encode::EncodePool pool(1, 1);
    const auto pipeline = makePipeline(pool);
    std::vector<std::byte> bytes(100, std::byte{7});
    pipeline->push(file(1, bytes));
    ASSERT_TRUE(sink_->waitForFrames(1));
    waitForProgress(1);
    const auto ready = sink_->frames()[0];
    std::ranges::fill(bytes, std::byte{0}); // the slot's, which is the next frame's
    EXPECT_EQ(*ready.bytes, std::vector<std::byte>(100, std::byte{7}));
    EXPECT_EQ(ready.record.encoded_bytes, 100U);
    EXPECT_TRUE(ready.record.key);
    EXPECT_EQ(ended_leases_, 1);
    EXPECT_EQ(pipeline->size(), 0U);
    EXPECT_EQ(fates_->encoded, 1U);
}

TEST_F(FramePipelineTest, Depth_IsNumberedAnewOnlyWhereItDiffers) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    constexpr DepthMeshSize kMesh(kSide, kSide);
    const std::vector<float> near(kMesh.vertexCount(), 1);
    std::vector<float> far = near;
    far[2] = 0.5F;
    const auto push = [&](uint64_t id, const std::vector<float>* mesh, uint64_t version,
                          session::Refinement refinement) {
        PixelView view{pixels_.data(), kSide, kSide, size_t{4} * kSide};
        view.outputs[static_cast<size_t>(Output::kDepthMesh)] = mesh ? mesh->data() : nullptr;
        DrawnFrame drawn = frameOf(id, view);
        drawn.record.width_px = drawn.record.height_px = kSide;
        drawn.record.delivered.refinement = refinement;
        drawn.version = version;
        pipeline->push(std::move(drawn));
        ASSERT_TRUE(sink_->waitForFrames(id));
        waitForProgress(static_cast<int>(id));
    };
    using session::Refinement;
    push(1, nullptr, 1, Refinement::kInteractive);
    push(2, &near, 1, Refinement::kInteractive);
    push(3, &near, 2, Refinement::kInteractive); // a light moved
    push(4, &far, 3, Refinement::kInteractive);
    push(5, nullptr, 3, Refinement::kHigh);        // the same view, refined
    push(6, nullptr, 3, Refinement::kInteractive); // nobody asks for it any more
    push(7, nullptr, 4, Refinement::kHigh);        // another view
    std::vector<uint64_t> numbers;
    for (const auto& ready : sink_->frames()) {
        numbers.push_back(ready.record.depth_mesh);
        EXPECT_EQ(ready.depth != nullptr, ready.record.depth_mesh > 0);
    }
    EXPECT_EQ(numbers, (std::vector<uint64_t>{0, 1, 1, 2, 2, 0, 0}));
    const auto& mesh = *sink_->frames()[3].depth;
    EXPECT_EQ(mesh.size, kMesh);
    EXPECT_EQ(protocol::decodeDepthMesh(mesh.bytes, mesh.size, mesh.bits).value()[2], 256);
}

TEST_F(FramePipelineTest, DepthOfVideo_HasEverySecondVertex) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    const DepthMeshSize drawn(kSide, kSide); // 3 x 3, at pixels 0, 8 and 15
    const std::vector<float> vertices = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    PixelView view{pixels_.data(), kSide, kSide, size_t{4} * kSide};
    view.outputs[static_cast<size_t>(Output::kDepthMesh)] = vertices.data();
    DrawnFrame frame = frameOf(1, view);
    frame.record.width_px = frame.record.height_px = kSide;
    frame.record.delivered.encoding.codec = settings::Codec::kVp9;
    pipeline->push(std::move(frame));
    ASSERT_TRUE(sink_->waitForFrames(1));
    const auto& mesh = *sink_->frames()[0].depth;
    EXPECT_EQ(drawn.vertexCount(), vertices.size());
    EXPECT_EQ(mesh.cell_px, 16U);
    EXPECT_EQ(mesh.size, DepthMeshSize(kSide, kSide, 16)); // at pixels 0 and 15
    const auto steps = protocol::decodeDepthMesh(mesh.bytes, mesh.size, mesh.bits).value();
    EXPECT_EQ(steps, (std::vector<uint16_t>{28, 85, 198, 255}));
}

TEST_F(FramePipelineTest, Push_FileBehindAPictureInTheEncoder_LeavesAfterIt) {
    encode::EncodePool pool(1, 4);
    std::latch release(1);
    occupy(pool, release);
    const auto pipeline = makePipeline(pool);
    const std::vector<std::byte> bytes(100);
    pipeline->push(frame(1));
    pipeline->push(file(2, bytes));
    EXPECT_TRUE(sink_->frames().empty());
    release.count_down();
    ASSERT_TRUE(sink_->waitForFrames(2));
    EXPECT_EQ(sink_->frames()[0].record.frame_id, 1U);
    EXPECT_EQ(sink_->frames()[1].record.frame_id, 2U);
}

TEST_F(FramePipelineTest, Push_FileThatDoesNotFit_IsToldAndNotTriedAgain) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    pipeline->push(file(1, {}));
    waitForProgress(1);
    EXPECT_TRUE(sink_->frames().empty());
    EXPECT_EQ(fates_->not_encoded, 1U);
    const auto losses = pipeline->takeLosses();
    EXPECT_EQ(losses.count, 1U);
    EXPECT_FALSE(losses.retry);
    EXPECT_EQ(ended_leases_, 1);
}

// The view rested, and moves again before anything was done for the rest.
TEST_F(FramePipelineTest, Push_BehindALosslessThatWaits_TakesItsPlace) {
    encode::EncodePool pool(1, 4);
    std::latch release(1);
    occupy(pool, release, true);
    occupy(pool, release); // so that the second one is there to be counted
    const auto pipeline = makePipeline(pool);
    DrawnFrame rest = frame(1);
    rest.record.delivered = session::delivered({}, {}, session::Refinement::kLossless);
    pipeline->push(std::move(rest));
    EXPECT_EQ(pipeline->size(), 1U);
    pipeline->push(frame(2));
    EXPECT_EQ(pipeline->size(), 1U);
    EXPECT_EQ(ended_leases_, 1);
    const auto losses = pipeline->takeLosses();
    EXPECT_EQ(losses.count, 1U);
    EXPECT_FALSE(losses.retry) << "a newer picture shows what it would";
    release.count_down();
    ASSERT_TRUE(sink_->waitForFrames(1));
    EXPECT_EQ(sink_->frames()[0].record.frame_id, 2U);
}

TEST_F(FramePipelineTest, Size_EncoderIsBusy_CountsBothPictures) {
    encode::EncodePool pool(1, 4);
    std::latch release(1);
    occupy(pool, release);
    const auto pipeline = makePipeline(pool);
    pipeline->push(frame(1));
    pipeline->push(frame(2));
    EXPECT_EQ(pipeline->size(), FramePipeline::kCapacity);
    release.count_down();
    ASSERT_TRUE(sink_->waitForFrames(2));
    waitForProgress(2);
    EXPECT_EQ(pipeline->size(), 0U);
}

TEST_F(FramePipelineTest, Push_NoEncoderMakesOneOfIt_TellsWhoWaits) {
    constexpr uint32_t kWiderThanJpeg = 65'536;
    std::vector<std::byte> row(size_t{4} * kWiderThanJpeg);
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    DrawnFrame wide = frame(1);
    wide.pixels = PixelLease({row.data(), kWiderThanJpeg, 1, row.size()}, nullptr);
    pipeline->push(std::move(wide));
    ASSERT_TRUE(sink_->waitFor([](const auto& record) { return !record.not_encoded.empty(); }));
    waitForProgress(1);
    const auto losses = pipeline->takeLosses();
    EXPECT_EQ(losses.count, 1U);
    EXPECT_FALSE(losses.retry);
}

TEST_F(FramePipelineTest, Push_EncodersAreFull_ReportsTheLossForARetry) {
    encode::EncodePool pool(1, 1);
    std::latch release(1);
    occupy(pool, release); // the thread
    occupy(pool, release); // the queue
    const auto pipeline = makePipeline(pool);
    pipeline->push(frame(1));
    const auto losses = pipeline->takeLosses();
    EXPECT_EQ(losses.count, 1U);
    EXPECT_TRUE(losses.retry);
    EXPECT_EQ(pipeline->takeLosses().count, 0U);
    EXPECT_EQ(pipeline->size(), 0U);
    EXPECT_EQ(ended_leases_, 1);
    release.count_down();
}

TEST_F(FramePipelineTest, Push_PictureCannotBeEncoded_IsLostWithoutRetry) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    DrawnFrame bad = frame(1);
    bad.record.delivered.encoding.quality = 0;
    pipeline->push(std::move(bad));
    progress_.wait(0);
    const auto losses = pipeline->takeLosses();
    EXPECT_EQ(losses.count, 1U);
    EXPECT_FALSE(losses.retry);
}

TEST_F(FramePipelineTest, Push_SinkIsGone_StillEndsTheLease) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    sink_.reset();
    pipeline->push(frame(1));
    progress_.wait(0);
    EXPECT_EQ(ended_leases_, 1);
}

TEST_F(FramePipelineTest, Video_KeyFrameFirstOnRequestAndAfterJpeg) {
    encode::EncodePool pool(2, 4);
    const auto pipeline = makePipeline(pool);
    int sent = 0;
    const auto push = [&](DrawnFrame drawn) {
        pipeline->push(std::move(drawn));
        waitForProgress(++sent);
    };
    push(video(1));
    push(video(2));
    push(video(3, 1)); // asked for
    push(video(4, 1)); // once
    push(frame(5));
    push(video(6, 1));
    push(video(7, 1));
    DrawnFrame still = frame(8);
    still.key_requests = 1;
    still.record.delivered.refinement = session::Refinement::kHigh;
    push(std::move(still));
    push(video(9, 1));
    EXPECT_EQ(kinds(), "KdKdjKdjd");
}

TEST_F(FramePipelineTest, Video_EncodersAreFull_LosesAPictureThatNoFrameRefersTo) {
    encode::EncodePool pool(1, 1);
    const auto pipeline = makePipeline(pool);
    pipeline->push(video(1));
    waitForProgress(1);
    std::latch release(1);
    occupy(pool, release); // the thread
    occupy(pool, release); // the queue
    pipeline->push(video(2, 1));
    EXPECT_EQ(pipeline->takeLosses().count, 1U);
    release.count_down();
    for (uint64_t id = 3; sink_->frames().size() < 2; ++id) { // until the queue has room
        pipeline->push(video(id, 1));
        waitForProgress(static_cast<int>(id));
    }
    EXPECT_EQ(kinds(), "KK") << "the request of the lost picture still holds";
}

TEST_F(FramePipelineTest, Video_PictureCannotBeEncoded_NextIsAKeyFrame) {
    encode::EncodePool pool(1, 4);
    const auto pipeline = makePipeline(pool);
    pipeline->push(video(1));
    waitForProgress(1);
    DrawnFrame bad = video(2);
    bad.record.delivered.encoding.video_kbps = 0;
    pipeline->push(std::move(bad));
    waitForProgress(2);
    pipeline->push(video(3));
    ASSERT_TRUE(sink_->waitForFrames(2));
    EXPECT_EQ(kinds(), "KK");
}

} // namespace
} // namespace froxel::stream
