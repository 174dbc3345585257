#include "app/load_capacity.h"
#include "app/load_early_stop.h"
#include "app/load_report.h"
#include "app/load_series.h"
#include "app/load_verdict.h"
#include "app/output_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace froxel::app {
namespace {

// Latencies of `base_ms` to `base_ms` + 99, 50 frames a second for 2 s.
load::ViewerResult viewer(double base_ms) {
    load::ViewerResult result;
    result.tried = true;
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
    result.tried = true;
    result.failure = why;
    return result;
}

load::RunResult run(std::vector<load::ViewerResult> viewers) {
    return {std::move(viewers), 2, false, false};
}

nlohmann::ordered_json reportOf(const LoadOptions& options, const load::RunResult& result) {
    load::RunOptions run_options;
    for (const std::string& script : options.scripts) {
        run_options.scripts.push_back(
            {std::filesystem::path(script).filename().string(), load::Idle{}, 1});
    }
    return loadReport(options, run_options, result, loadVerdict({}, result), {});
}

TEST(LoadReport, Figures_OfEachAndAll_AreThose) {
    const auto report = reportOf({}, run({viewer(0), viewer(100)}));
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
    const auto report = reportOf({}, run({failed("it broke")}));
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
    options.scripts = {"/home/someone/drag.jsonl"};
    const auto report = reportOf(options, run({one, other, one, failed("it broke")}));
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
    EXPECT_EQ(report["scripts"][0]["name"], "drag.jsonl");
    EXPECT_EQ(report.dump().find("/home"), std::string::npos);
}

std::vector<load::Requirement> required(const std::string& text) {
    return load::parseRequirements(text).value();
}

TEST(LoadVerdict, Held_HasNoBrokenLine) {
    const auto verdict = loadVerdict(required("latency.p95<=94, fps>=50"), run({viewer(0)}));
    EXPECT_TRUE(verdict.held());
    EXPECT_EQ(brokenLine(verdict), std::nullopt);
}

TEST(LoadVerdict, Broken_IsNamedWithWhatWasMeasured) {
    const auto verdict =
        loadVerdict(required("latency.p95<90, fps>=50, stall<10"), run({viewer(0)}));
    EXPECT_FALSE(verdict.held());
    EXPECT_EQ(brokenLine(verdict),
              "broken requirement latency.p95<90: 94; broken requirement stall<10: 19.6");
}

TEST(LoadVerdict, Failures_AreCountedAndTheFirstNamed) {
    EXPECT_EQ(brokenLine(loadVerdict({}, run({viewer(0), failed("it broke"), failed("it, too")}))),
              "2 of 3 viewers failed: viewer 2: it broke");
}

TEST(LoadVerdict, ShareThatMayFail_IsNoFailure) {
    auto refused = failed("full");
    refused.refused = true;
    EXPECT_EQ(brokenLine(loadVerdict(required("refused<=50%"), run({viewer(0), refused}))),
              std::nullopt);
    EXPECT_EQ(brokenLine(loadVerdict(required("failed<=50%"), run({viewer(0), refused}))),
              "1 of 2 viewers failed: viewer 2: full");
    EXPECT_EQ(brokenLine(loadVerdict(required("refused<50%"), run({viewer(0), refused}))),
              "broken requirement refused<50%: 0.5");
}

TEST(LoadJunit, Requirements_AreTestCases) {
    const LoadVerdict verdict = loadVerdict(required("latency.p95<90, fps>=50"), run({viewer(0)}));
    const std::string xml = junitOf("froxel load", casesOf(verdict), 2);
    EXPECT_NE(xml.find(R"(classname="froxel.load")"), std::string::npos) << xml;
    EXPECT_NE(xml.find(R"(tests="3" failures="1" time="2.000")"), std::string::npos) << xml;
    EXPECT_NE(xml.find(R"(name="fps&gt;=50"/>)"), std::string::npos) << xml;
    EXPECT_NE(xml.find(R"(<failure message="latency.p95&lt;90: 94"/>)"), std::string::npos) << xml;
}

load::RunSecond second(double elapsed_s, std::vector<load::ViewerChange> changes) {
    load::RunSecond now;
    now.measuring = true;
    now.elapsed = Seconds(elapsed_s);
    now.length = Seconds(1);
    now.changes = std::move(changes);
    return now;
}

load::ViewerChange watching(double latency_ms, int frames) {
    load::ViewerChange change;
    change.watching = true;
    change.received_bytes = 125'000;
    change.measured.seconds = 1;
    change.measured.frames = static_cast<uint64_t>(frames);
    change.measured.samples.latency_ms.assign(static_cast<size_t>(frames), latency_ms);
    return change;
}

TEST(LoadSeries, Row_CountsViewersAndAddsThemUp) {
    load::ViewerChange joining;
    joining.joining = true;
    load::ViewerChange refused;
    refused.failure = "full";
    refused.refused = true;
    auto waits = watching(0, 0);
    waits.waiting.interval_ms = {1500};
    const auto row =
        seriesRowOf(second(3, {watching(20, 30), watching(40, 10), joining, refused, waits}));
    EXPECT_EQ(valueIn(row, "elapsed_s"), 3);
    EXPECT_EQ(valueIn(row, "viewers"), 3);
    EXPECT_EQ(valueIn(row, "joining"), 1);
    EXPECT_EQ(valueIn(row, "refused"), 1);
    EXPECT_EQ(valueIn(row, "failed"), 0);
    EXPECT_EQ(valueIn(row, "frames_per_s"), 40);
    EXPECT_EQ(valueIn(row, "mbit_per_s"), 3);
    EXPECT_EQ(valueIn(row, "latency_p50_ms"), 20);
    EXPECT_EQ(valueIn(row, "latency_p95_ms"), 40);
    EXPECT_EQ(valueIn(row, "reaction_p95_ms"), std::nullopt);
    EXPECT_EQ(valueIn(row, "longest_wait_ms"), 1500);
}

TEST(LoadSeries, Formats_LeaveOutWhatWasNotMeasured) {
    const auto row = seriesRowOf(second(1.5, {watching(20, 30)}));
    EXPECT_EQ(csvOf(row), "1.5,1,0,0,0,30,1,20,20,20,,,0\n");
    EXPECT_EQ(jsonOf(row)["reaction_p95_ms"], nullptr);
    EXPECT_EQ(jsonOf(row)["viewers"].dump(), "1");
    const std::string prometheus = prometheusOf(row);
    EXPECT_NE(prometheus.find("# TYPE froxel_load_viewers gauge\nfroxel_load_viewers 1\n"),
              std::string::npos);
    EXPECT_EQ(prometheus.find("reaction"), std::string::npos);
}

TEST(LoadSeries, PrometheusFile_HasTheNewestRowAlone) {
    const std::string path = testing::TempDir() + "froxel_series.prom";
    SeriesFile file(path);
    file.add(seriesRowOf(second(1, {})));
    file.add(seriesRowOf(second(2, {})));
    const std::string text = readText(path).value();
    EXPECT_NE(text.find("froxel_load_elapsed_s 2\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("froxel_load_elapsed_s 1\n"), std::string::npos) << text;
    std::filesystem::remove(path);
}

TEST(LoadEarlyStop, Requirement_BrokenForLongEnough_EndsTheRun) {
    LoadEarlyStop stop(required("fps>=30"), Seconds(2));
    EXPECT_TRUE(stop.goesOn(second(1, {watching(20, 60)})));
    EXPECT_TRUE(stop.goesOn(second(2, {watching(20, 0)}))) << "30 so far";
    EXPECT_TRUE(stop.goesOn(second(3, {watching(20, 0)}))) << "20, for a second";
    EXPECT_TRUE(stop.goesOn(second(4, {watching(20, 90)}))) << "37 again";
    EXPECT_TRUE(stop.goesOn(second(5, {watching(20, 0)}))) << "30";
    EXPECT_TRUE(stop.goesOn(second(6, {watching(20, 0)})));
    EXPECT_FALSE(stop.goesOn(second(7, {watching(20, 0)})));
}

TEST(LoadEarlyStop, WhatOnlyWaits_IsNotMeasuredTwice) {
    LoadEarlyStop stop(required("interval.max<1000"), Seconds(1));
    auto waits = watching(20, 1);
    waits.waiting.interval_ms = {900};
    EXPECT_TRUE(stop.goesOn(second(1, {waits})));
    waits.waiting.interval_ms = {1900};
    EXPECT_FALSE(stop.goesOn(second(2, {waits})));
    LoadEarlyStop other(required("interval.mean<1000"), Seconds(1));
    for (int at = 1; at < 5; ++at) {
        auto long_wait = watching(20, 0);
        long_wait.waiting.interval_ms = {900};
        EXPECT_TRUE(other.goesOn(second(at, {long_wait})));
    }
}

TEST(LoadEarlyStop, NothingMeasuredYet_IsNotBroken) {
    LoadEarlyStop stop(required("latency.p95<10"), Seconds(1));
    EXPECT_TRUE(stop.goesOn(second(1, {load::ViewerChange{}})));
    EXPECT_TRUE(stop.goesOn(second(2, {load::ViewerChange{}})));
}

load::CapacitySearch searched(uint32_t limit, uint32_t most, std::vector<LoadTrial>& trials) {
    load::CapacitySearch search(most, 2);
    while (const auto viewers = search.next()) {
        const bool held = *viewers <= limit;
        search.note(*viewers, held);
        trials.push_back({*viewers,
                          held,
                          held ? std::nullopt : std::optional<std::string>("slow"),
                          {{"fps>=30", held ? 60 : 20, held}},
                          {}});
    }
    return search;
}

TEST(LoadCapacity, Text_SaysHowSureItIs) {
    std::vector<LoadTrial> trials;
    const auto search = searched(6, 100, trials);
    EXPECT_EQ(capacityText(search, trials, false),
              "capacity: 6 viewers (held in 2 of 2 trials with 6 viewers, held in 0 of 2 trials "
              "with 7 viewers)\n");
    EXPECT_EQ(trialLine(trials.front()), "    1 viewers  held    fps>=30: 60\n");
    trials.clear();
    EXPECT_EQ(capacityText(searched(6, 4, trials), trials, false),
              "capacity: at least 4 viewers (held in 2 of 2 trials with 4 viewers)\n");
    EXPECT_EQ(capacityText(searched(6, 4, trials), {}, true),
              "stopped after 0 trials; 4 viewers held so far\n");
}

TEST(LoadCapacity, Report_HasEveryTrial) {
    std::vector<LoadTrial> trials;
    const auto search = searched(1, 100, trials);
    const auto report = capacityReport({}, {}, search, trials, false);
    EXPECT_EQ(report["schema"], "froxel.capacity.v1");
    EXPECT_EQ(report["capacity"], 1);
    EXPECT_EQ(report["broken_from"], 2);
    EXPECT_EQ(report["required"][0], "fps>=30");
    EXPECT_EQ(report["trials"].size(), 4U);
    EXPECT_EQ(report["trials"][1]["broken"], "slow");
}

TEST(LoadTable, Viewers_AFew_AreListed_ManyAreNot) {
    EXPECT_EQ(loadTable(run({failed("at once")}), {}), "");
    const std::string few = loadTable(run({viewer(0), viewer(100)}), {});
    EXPECT_NE(few.find("\n   all     100.0 "), std::string::npos) << few;
    EXPECT_NE(few.find("\n     2      50.0 "), std::string::npos) << few;
    const std::string many = loadTable(run(std::vector<load::ViewerResult>(17, viewer(0))), {});
    EXPECT_EQ(many.find("\n     2 "), std::string::npos) << many;
}

TEST(LoadProgress, SaysWhoIsThere) {
    load::RunOptions options;
    options.visits.resize(4);
    load::RunSecond joining;
    joining.joined = 3;
    joining.ended = 1;
    EXPECT_EQ(loadProgress(options, joining, seriesRowOf(joining)),
              "joining: 3 of 4 viewers, 1 failed");
    const auto watched = second(2, {watching(20, 30)});
    EXPECT_EQ(loadProgress(options, watched, seriesRowOf(watched)),
              "2 s, 1 viewers, 0 joining, 0 failed, 30 frames/s, 1.0 Mbit/s");
}

} // namespace
} // namespace froxel::app
