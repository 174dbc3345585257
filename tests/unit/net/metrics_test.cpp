#include "net/metrics.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::net {
namespace {

using testing::HasSubstr;
using testing::Not;

session::FrameRecord recordWith(std::vector<MemoryUse> memory) {
    session::FrameRecord record;
    record.render_us = 20'000;
    record.stats.lists.p95 = 33;
    record.stats.details =
        std::make_shared<const FrameDetails>(FrameDetails{{}, std::move(memory)});
    return record;
}

TEST(Metrics, AtFirst_CountersAreThereAndZero) {
    const std::string text = Metrics().text();
    EXPECT_THAT(text, HasSubstr("# TYPE froxel_sessions gauge\nfroxel_sessions 0\n"));
    EXPECT_THAT(text, HasSubstr("# TYPE froxel_frames_sent_total counter\n"));
    EXPECT_THAT(text, HasSubstr("froxel_light_pairs_total{kind=\"contributing\"} 0\n"));
}

TEST(Metrics, Sessions_ComeAndGo) {
    Metrics metrics;
    metrics.sessionOpened();
    metrics.sessionOpened();
    metrics.sessionClosed();
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_sessions 1\n"));
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_sessions_opened_total 2\n"));
}

TEST(Metrics, FrameSent_FillsHistogramsAndGauges) {
    Metrics metrics;
    metrics.frameSent(recordWith({}));
    metrics.frameDropped();
    metrics.bytesSent(1000);
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_sum{stage=\"render\"} 0.02\n"));
    EXPECT_THAT(text, HasSubstr("_bucket{stage=\"render\",le=\"0.016\"} 0\n"));
    EXPECT_THAT(text, HasSubstr("_bucket{stage=\"render\",le=\"0.033\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_light_list_p95_entries 33\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_sent_total 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_dropped_total 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_sent_bytes_total 1000\n"));
}

TEST(Metrics, Pairs_OnlyOfFramesThatCountedThem) {
    Metrics metrics;
    auto record = recordWith({});
    record.stats.pairs = {true, 100, 40};
    metrics.frameSent(record);
    record.stats.pairs.counted = false;
    metrics.frameSent(record);
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_light_pairs_total{kind=\"evaluated\"} 100\n"));
}

TEST(Metrics, Memory_APurposeThatIsGone_LeavesNoRow) {
    Metrics metrics;
    metrics.frameSent(recordWith({{"textures", 7}, {"light lists", 8}}));
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_device_memory_bytes{purpose=\"textures\"} 7\n"));
    metrics.frameSent(recordWith({{"light lists", 9}}));
    EXPECT_THAT(metrics.text(),
                HasSubstr("froxel_device_memory_bytes{purpose=\"light lists\"} 9\n"));
    EXPECT_THAT(metrics.text(), Not(HasSubstr("textures")));
}

} // namespace
} // namespace froxel::net
