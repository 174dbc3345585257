#include "app/load_report.h"
#include "app/load_verdict.h"

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

TEST(LoadReport, Served_SaysWhatWasMeasured_EachOnce) {
    auto one = viewer(0);
    one.served = load::Served{"1.2.3", "NVIDIA H200", "Sponza",       262'267, 1280, 720,
                              1000,    true,          "forward_plus", "jpeg",  85,   4000};
    one.measured.smallest = load::PictureSize{512, 288};
    one.measured.largest = load::PictureSize{1280, 720};
    one.measured.commands_unshown = 3;
    auto other = one;
    other.served->device = "llvmpipe";
    other.measured.smallest = load::PictureSize{640, 360};
    LoadOptions options;
    options.script = "/home/someone/drag.jsonl";
    const auto report = loadReport(options, run({one, other, one, failed("it broke")}));
    ASSERT_EQ(report["served"].size(), 2U);
    const auto& served = report["served"][0];
    EXPECT_EQ(served["viewers"], 2);
    EXPECT_EQ(served["device"], "NVIDIA H200");
    EXPECT_EQ(served["scene"], "Sponza");
    EXPECT_EQ(served["size"]["width_px"], 1280);
    EXPECT_EQ(served["lights"], 1000);
    EXPECT_EQ(served["codec"], "jpeg");
    EXPECT_EQ(report["served"][1]["device"], "llvmpipe");
    EXPECT_EQ(report["all"]["smallest_picture"]["width_px"], 512);
    EXPECT_EQ(report["all"]["largest_picture"]["height_px"], 720);
    EXPECT_EQ(report["all"]["commands_unshown"], 9);
    EXPECT_EQ(report["each"][3]["largest_picture"], nullptr);
    EXPECT_EQ(report["script"], "drag.jsonl");
    EXPECT_EQ(report.dump().find("/home"), std::string::npos);
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

// 60 frames a second for 10 s, then none for 20 s.
load::ViewerResult frozen() {
    load::ViewerResult result;
    load::Measured& measured = result.measured;
    measured.seconds = 30;
    measured.frames = 600;
    measured.samples.latency_ms.assign(600, 5);
    measured.samples.interval_ms.assign(600, 1000.0 / 60);
    measured.samples.interval_ms.push_back(20'000);
    return result;
}

TEST(LoadVerdict, Stall_IsHowLongMoreThanATwentiethOfTheTimeWaited) {
    EXPECT_NEAR(stallMs(frozen().measured), 18'500, 1e-6);
    EXPECT_NEAR(stallMs(viewer(0).measured), 19.6, 1e-9) << "0.1 of 2 s lies beyond it";
    EXPECT_EQ(stallMs({}), 0);
}

TEST(LoadVerdict, ServerThatFreezes_BreaksTheBound_ThoughItsLatenciesWereShort) {
    LoadOptions options;
    options.max_latency_ms = 1000;
    EXPECT_EQ(loadVerdict(options, run({viewer(0), frozen()})),
              "1 of 2 viewers broke --max-latency-ms 1000: viewer 2 stalled for 18500.0 ms");
    auto watcher = frozen();
    watcher.controlled = false;
    watcher.measured.samples.latency_ms.clear();
    EXPECT_NE(loadVerdict(options, run({watcher})), std::nullopt) << "a watcher as well";
    watcher.measured.samples.interval_ms.pop_back();
    EXPECT_EQ(loadVerdict(options, run({watcher})), std::nullopt);
}

TEST(LoadVerdict, Commands_ThatWait_BreakTheBound) {
    LoadOptions options;
    options.max_latency_ms = 1000;
    auto slow = viewer(0);
    slow.measured.samples.reaction_ms.assign(90, 40);
    slow.measured.samples.reaction_ms.insert(slow.measured.samples.reaction_ms.end(), 10, 1500);
    EXPECT_EQ(loadVerdict(options, run({slow})),
              "1 of 1 viewers broke --max-latency-ms 1000: viewer 1 has a p95 reaction of "
              "1500.0 ms");
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
