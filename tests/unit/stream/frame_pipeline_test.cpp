#include "stream/frame_pipeline.h"
#include "support/recording_sink.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <latch>
#include <thread>

namespace froxel::stream {
namespace {

constexpr uint32_t kSide = 16;

class FramePipelineTest : public testing::Test {
  protected:
    DrawnFrame frame(uint64_t id) {
        DrawnFrame drawn;
        drawn.pixels = PixelLease({pixels_.data(), kSide, kSide, size_t{4} * kSide},
                                  [this] { ++ended_leases_; });
        drawn.record.frame_id = id;
        drawn.drawn_at = Clock::now();
        return drawn;
    }
    // Another viewer's job, which does not end before the latch opens.
    void occupy(encode::EncodePool& pool, std::latch& release) {
        encode::EncodeJob job{
            PixelLease({pixels_.data(), kSide, kSide, size_t{4} * kSide}, nullptr),
            {},
            [&](const Result<EncodedFrame>&) { release.wait(); }};
        while (!pool.submit(std::move(job))) {
            std::this_thread::yield(); // the thread has not taken the job before this one yet
        }
    }
    std::shared_ptr<FramePipeline> makePipeline(encode::EncodePool& pool) {
        return std::make_shared<FramePipeline>(pool, sink_, [this] {
            ++progress_;
            progress_.notify_all();
        });
    }

    std::array<std::byte, size_t{4} * kSide * kSide> pixels_{};
    std::atomic<int> ended_leases_ = 0;
    std::atomic<int> progress_ = 0;
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
    EXPECT_EQ(ended_leases_, 2);
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
    for (int seen = progress_; seen < 2; seen = progress_) {
        progress_.wait(seen);
    }
    EXPECT_EQ(pipeline->size(), 0U);
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
    bad.encoding.quality = 0;
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

} // namespace
} // namespace froxel::stream
