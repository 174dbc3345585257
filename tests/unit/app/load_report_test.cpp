#include "app/load_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace froxel::app {
namespace {

// Latencies of `base_ms` to `base_ms` + 99, 50 frames a second for 2 s.
load::ViewerResult viewer(double base_ms) {
    load::ViewerResult result;
    result.first_frame_ms = 120;
    result.received_bytes = 1'000'000;
    load::Measured& measured = result.measured;
    measured.seconds = 2;
    measured.frames = 100;
    for (int index = 0; index < 100; ++index) {
        measured.samples.latency_ms.push_back(base_ms + index);
        measured.samples.interval_ms.push_back(index < 98 ? 20 : 50);
    }
    return result;
}

load::ViewerResult failed(const std::string& why) {
    load::ViewerResult result;
    result.failure = why;
    return result;
}

load::RunResult run(std::vector<load::ViewerResult> viewers) {
    return {std::move(viewers), 2, false};
}

TEST(LoadReport, Figures_OfEachAndAll_AreThose) {
    const auto report = loadReport({}, run({viewer(0), viewer(100)}));
    const auto& each = report["each"];
    EXPECT_EQ(each[0]["latency_ms"]["p95"], 94);
    EXPECT_EQ(each[0]["frames_per_s"], 50);
    EXPECT_EQ(each[0]["jitter_ms"], 30);
    EXPECT_EQ(each[0]["received_bytes_per_s"], 500'000);
    EXPECT_EQ(each[1]["failure"], nullptr);
    EXPECT_EQ(report["all"]["frames_per_s"], 100);
    EXPECT_EQ(report["all"]["latency_ms"]["count"], 200);
    EXPECT_EQ(report["all"]["latency_ms"]["p95"], 189);
    EXPECT_EQ(report["broken"], nullptr);
}

TEST(LoadReport, NoSample_IsNull) {
    const auto report = loadReport({}, run({failed("it broke")}));
    EXPECT_EQ(report["all"]["latency_ms"], nullptr);
    EXPECT_EQ(report["all"]["jitter_ms"], nullptr);
    EXPECT_EQ(report["each"][0]["failure"], "it broke");
    EXPECT_EQ(report["each"][0]["first_frame_ms"], nullptr);
}

TEST(LoadVerdict, WithinBounds_IsNone) {
    LoadOptions options;
    options.max_latency_ms = 94;
    options.min_fps = 50;
    EXPECT_EQ(loadVerdict(options, run({viewer(0)})), std::nullopt);
}

TEST(LoadVerdict, Broken_NamesTheWorstViewer) {
    LoadOptions options;
    options.max_latency_ms = 93;
    EXPECT_EQ(loadVerdict(options, run({viewer(0), viewer(40), viewer(7)})),
              "3 of 3 viewers broke --max-latency-ms 93: viewer 2 has p95 134.0 ms");
    options.max_latency_ms.reset();
    options.min_fps = 51;
    auto slow = viewer(0);
    slow.measured.frames = 10;
    EXPECT_EQ(loadVerdict(options, run({viewer(0), slow})),
              "2 of 2 viewers broke --min-fps 51: viewer 2 has 5.0 frames/s");
}

TEST(LoadVerdict, NoLatency_BreaksAnyBound) {
    LoadOptions options;
    options.max_latency_ms = 1000;
    auto still = viewer(0);
    still.measured.samples.latency_ms.clear();
    EXPECT_EQ(loadVerdict(options, run({viewer(0), still})),
              "1 of 2 viewers broke --max-latency-ms 1000: viewer 2 measured no latency");
}

TEST(LoadVerdict, Failures_AreCountedAndTheFirstNamed) {
    EXPECT_EQ(loadVerdict({}, run({viewer(0), failed("it broke"), failed("it, too")})),
              "2 of 3 viewers failed: viewer 2: it broke");
}

TEST(LoadTable, Viewers_AFew_AreListed_ManyAreNot) {
    EXPECT_EQ(loadTable(run({failed("at once")})), "");
    const std::string few = loadTable(run({viewer(0), viewer(100)}));
    EXPECT_NE(few.find("\n   all     100.0 "), std::string::npos) << few;
    EXPECT_NE(few.find("\n     2      50.0 "), std::string::npos) << few;
    const std::string many = loadTable(run(std::vector<load::ViewerResult>(17, viewer(0))));
    EXPECT_EQ(many.find("\n     2 "), std::string::npos) << many;
}

TEST(LoadProgress, Rates_AreOfTheLastSecond) {
    LoadOptions options;
    options.viewer_count = 4;
    options.seconds = 30;
    const load::RunProgress joining{false, Seconds(1), 3, 1, 10, 1000};
    EXPECT_EQ(loadProgress(options, joining, {}), "joining: 3 of 4 viewers, 1 failed");
    const load::RunProgress first{true, Seconds(1), 4, 1, 60, 126'000};
    EXPECT_EQ(loadProgress(options, first, joining),
              "1 of 30 s, 3 viewers, 50 frames/s, 1.0 Mbit/s");
    const load::RunProgress second{true, Seconds(2), 4, 1, 90, 126'000};
    EXPECT_EQ(loadProgress(options, second, first),
              "2 of 30 s, 3 viewers, 30 frames/s, 0.0 Mbit/s");
}

} // namespace
} // namespace froxel::app
