#include "net/metrics.h"
#include "protocol/limits.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::net {
namespace {

using testing::HasSubstr;
using testing::Not;

session::FrameRecord aRecord() {
    session::FrameRecord record;
    record.render_us = 20'000;
    record.stats.lists.p95 = 33;
    return record;
}

TEST(Metrics, AtFirst_CountersAreThereAndZero) {
    const std::string text = Metrics().text();
    EXPECT_THAT(text, HasSubstr("# TYPE froxel_sessions gauge\nfroxel_sessions 0\n"));
    EXPECT_THAT(text, HasSubstr("# TYPE froxel_frames_sent_total counter\n"));
    EXPECT_THAT(text, HasSubstr("froxel_light_pairs_total{kind=\"contributing\"} 0\n"));
}

TEST(Metrics, Viewers_ComeAndGo) {
    Metrics metrics;
    metrics.sessionOpened();
    metrics.sessionOpened();
    metrics.sessionClosed();
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_viewers 1\n"));
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_viewers_joined_total 2\n"));
}

TEST(Metrics, Sessions_AreCountedWhenScraped) {
    size_t count = 2;
    const Metrics metrics("1.2.3", [&count] { return count; });
    EXPECT_THAT(metrics.text(), HasSubstr("# TYPE froxel_sessions gauge\nfroxel_sessions 2\n"));
    count = 1;
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_sessions 1\n"));
}

TEST(Metrics, FrameSent_FillsHistogramsAndGauges) {
    Metrics metrics;
    metrics.frameSent(aRecord());
    metrics.frameDropped();
    metrics.bytesSent(1000);
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_sum{stage=\"render\"} 0.02\n"));
    EXPECT_THAT(text, HasSubstr("_bucket{stage=\"render\",le=\"0.016\"} 0\n"));
    EXPECT_THAT(text, HasSubstr("_bucket{stage=\"render\",le=\"0.033\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_light_list_p95_entries 33\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_sent_total 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_dropped_total{reason=\"replaced\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_sent_bytes_total 1000\n"));
}

TEST(Metrics, FramesThatKeepSurfaces_AreCounted) {
    Metrics metrics;
    auto record = aRecord();
    metrics.frameSent(record);
    record.stats.surfaces_reused = true;
    metrics.frameSent(record);
    metrics.frameSent(record);
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_frames_kept_total 2\n"));
}

TEST(Metrics, Queue_OnlyOfFramesThatShowANewCommand) {
    Metrics metrics;
    auto record = aRecord();
    record.queue_us = 5'000; // of a first picture: since the viewer came
    metrics.frameSent(record);
    record.applied.seq = 7;
    metrics.frameSent(record);
    record.queue_us = 0;
    metrics.frameSent(record);
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_count{stage=\"queue\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_sum{stage=\"queue\"} 0.005\n"));
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_count{stage=\"render\"} 3\n"));
}

TEST(Metrics, TimeOnTheDevice_OnlyWhereItIsKnown) {
    Metrics metrics;
    auto record = aRecord();
    record.stats.gpu_us = 3'000;
    metrics.frameSent(record);
    record.stats.gpu_us = std::nullopt;
    metrics.frameSent(record);
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_count{stage=\"gpu\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_sum{stage=\"gpu\"} 0.003\n"));
    EXPECT_THAT(text, HasSubstr("froxel_stage_duration_seconds_count{stage=\"render\"} 2\n"));
}

TEST(Metrics, Fates_AreReadWhenScraped) {
    const Metrics metrics;
    const auto fates = metrics.fates();
    fates->rendered = 5;
    fates->encoded = 3;
    fates->samples = 15;
    fates->viewer_gone = 1;
    fates->given_up = 2;
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("# TYPE froxel_frames_rendered_total counter\n"
                                "froxel_frames_rendered_total 5\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_encoded_total 3\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_sampled_total 15\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_dropped_total{reason=\"viewer_gone\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_dropped_total{reason=\"not_encoded\"} 0\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_frames_dropped_total{reason=\"given_up\"} 2\n"));
}

TEST(Metrics, Steps_AreCountedByTheirLength) {
    Metrics metrics;
    metrics.frameBegun(Seconds(0.002));
    metrics.pieceDrawn(Seconds(0.3));
    metrics.pieceDrawn(Seconds(0.04));
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_frame_step_seconds_count{step=\"begin\"} 1\n"));
    EXPECT_THAT(text,
                HasSubstr("froxel_frame_step_seconds_bucket{step=\"piece\",le=\"0.25\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_frame_step_seconds_count{step=\"piece\"} 2\n"));
}

// Whatever viewers send, rows are bounded.
TEST(Metrics, EveryCloseCode_RowsAreBounded) {
    Metrics metrics;
    for (uint32_t code = 0; code <= 65535; ++code) {
        metrics.socketClosed(static_cast<uint16_t>(code));
    }
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("froxel_websocket_closes_total{code=\"1009\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_websocket_closes_total{code=\"other\"} "));
    EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 500);
}

TEST(Metrics, Rejects_AreCountedByReason) {
    Metrics metrics;
    metrics.commandRejected(session::RejectCode::kOutOfRange);
    metrics.commandRejected(session::RejectCode::kOutOfRange);
    EXPECT_THAT(metrics.text(),
                HasSubstr("froxel_command_rejects_total{reason=\"out_of_range\"} 2\n"));
}

TEST(Metrics, BuildAndProcess_AreThere) {
    const std::string text = Metrics("1.2.3").text();
    EXPECT_THAT(text, HasSubstr("version=\"1.2.3\"} 1\n"));
    for (const char* name :
         {"process_resident_memory_bytes", "process_open_fds", "process_max_fds", "process_threads",
          "process_heap_used_bytes", "process_cpu_seconds_total"}) {
        EXPECT_THAT(text, HasSubstr(std::string("\n") + name + " "));
    }
}

TEST(Metrics, Delivery_IsCountedByWhatFramesWereMadeWith) {
    Metrics metrics;
    auto record = aRecord();
    record.delivered = {0.75, {55, settings::Chroma::k420}, session::Refinement::kInteractive, 2};
    record.queue_delay_us = 30'000;
    metrics.frameSent(record);
    record.delivered = {1, {92, settings::Chroma::k444}, session::Refinement::kLossless, 0};
    metrics.frameSent(record);
    metrics.rateStepped(session::RateStep::kNone);
    metrics.rateStepped(session::RateStep::kCongested);
    const std::string text = metrics.text();
    EXPECT_THAT(text, HasSubstr("\nfroxel_frame_quality_sum 55\n")) << "lossless has none";
    EXPECT_THAT(text, HasSubstr("\nfroxel_frame_scale_bucket{le=\"0.75\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nfroxel_queue_delay_seconds_sum 0.06\n"));
    EXPECT_THAT(text, HasSubstr("froxel_refinement_frames_total{refinement=\"lossless\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_rate_steps_total{reason=\"congested\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("froxel_rate_steps_total{reason=\"recovered\"} 0\n"));
}

TEST(Metrics, Pairs_OnlyOfFramesThatCountedThem) {
    Metrics metrics;
    auto record = aRecord();
    static constexpr StatRow kEvaluated{"pairs", "evaluated", "evaluated"};
    record.stats.steps.set(kEvaluated, 100);
    metrics.frameSent(record);
    record.stats.steps = {};
    metrics.frameSent(record);
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_light_pairs_total{kind=\"evaluated\"} 100\n"));
}

TEST(Metrics, PeeledPictures_AddUpPixelsWithMoreLayers) {
    Metrics metrics;
    auto record = aRecord();
    metrics.frameSent(record);
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_peel_overflow_pixels_total 0\n"));
    static constexpr StatRow kOverflow{"peel", "overflow_pixels", "overflow_pixels"};
    record.stats.steps.set(kOverflow, 70);
    metrics.frameSent(record);
    metrics.frameSent(record);
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_peel_overflow_pixels_total 140\n"));
}

TEST(Metrics, Scenes_AreToldOfWhereThereAreSeveral) {
    Metrics metrics;
    EXPECT_EQ(metrics.text().find("froxel_scene"), std::string::npos);
    session::SceneCounts counts{.resident = 3, .loading = 1, .bytes = 77, .loaded_total = 4};
    metrics.watchScenes([&counts] { return counts; });
    counts.evicted_total = 2;
    const std::string text = metrics.text();
    for (const char* row :
         {"froxel_scenes{state=\"resident\"} 3", "froxel_scenes{state=\"loading\"} 1",
          "froxel_scene_memory_bytes 77", "froxel_scene_loads_total{result=\"loaded\"} 4",
          "froxel_scene_loads_total{result=\"failed\"} 0", "froxel_scenes_evicted_total 2"}) {
        EXPECT_NE(text.find(row), std::string::npos) << row << "\n" << text;
    }
}

TEST(Metrics, Uploads_AreCounted_OnlyWhereThereMayBeSome) {
    Metrics metrics;
    EXPECT_THAT(metrics.text(), Not(HasSubstr("froxel_upload")));
    guest::GuestStore::Counts counts{.receiving = 1, .ready = 2, .bytes = 77, .completed_total = 5};
    counts.removed_total = {1, 2, 3, 4};
    metrics.watchUploads([&counts] { return counts; });
    for (const char* row :
         {"froxel_uploads{state=\"receiving\"} 1\n", "froxel_uploads{state=\"ready\"} 2\n",
          "froxel_upload_bytes 77\n", "froxel_uploads_completed_total 5\n",
          "froxel_uploads_removed_total{reason=\"deleted\"} 1\n",
          "froxel_uploads_removed_total{reason=\"failed\"} 4\n"}) {
        EXPECT_THAT(metrics.text(), HasSubstr(row));
    }
}

TEST(Metrics, Memory_IsWhatItIsAtEachScrape) {
    Metrics metrics;
    EXPECT_THAT(metrics.text(), Not(HasSubstr("froxel_device_memory_bytes{")));
    std::vector<MemoryUse> uses{{"textures", 7}, {"light lists", 8}};
    metrics.watchMemory([&uses] { return uses; });
    EXPECT_THAT(metrics.text(), HasSubstr("froxel_device_memory_bytes{purpose=\"textures\"} 7\n"));
    uses = {{"light lists", 9}};
    EXPECT_THAT(metrics.text(),
                HasSubstr("froxel_device_memory_bytes{purpose=\"light lists\"} 9\n"));
    EXPECT_THAT(metrics.text(), Not(HasSubstr("textures")));
}

TEST(Metrics, EveryReason_HasARowFromTheStart) {
    const std::string text = Metrics().text();
    for (const auto code : protocol::kCloseCodes) {
        EXPECT_THAT(text, HasSubstr("froxel_websocket_closes_total{code=\"" +
                                    std::to_string(static_cast<unsigned>(code)) + "\"} 0\n"));
    }
    for (const auto code : session::kRejectCodes) {
        EXPECT_THAT(text, HasSubstr("froxel_command_rejects_total{reason=\"" +
                                    session::nameOf(code) + "\"} 0\n"));
    }
    EXPECT_THAT(text, HasSubstr("froxel_upgrades_refused_total{status=\"503\"} 0\n"));
}

TEST(Metrics, StartTime_IsInThePastAndStays) {
    const auto startOf = [](const std::string& text) {
        const std::string name = "\nprocess_start_time_seconds ";
        return std::stod(text.substr(text.find(name) + name.size()));
    };
    const Metrics metrics;
    const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
    const double start_s = startOf(metrics.text());
    EXPECT_LE(start_s, now.count());
    EXPECT_GT(start_s, now.count() - 24 * 3600);
    EXPECT_EQ(startOf(metrics.text()), start_s);
}

TEST(Metrics, Load_IsWhatItIsAtEachScrape) {
    Metrics metrics;
    EXPECT_THAT(metrics.text(),
                HasSubstr("# TYPE froxel_device_load gauge\nfroxel_device_load 0\n"));
    double load = 0.25;
    metrics.watchLoad([&load] { return load; });
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_device_load 0.25\n"));
    load = 1;
    EXPECT_THAT(metrics.text(), HasSubstr("\nfroxel_device_load 1\n"));
}

} // namespace
} // namespace froxel::net
