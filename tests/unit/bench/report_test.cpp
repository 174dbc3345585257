#include "bench/compare.h"
#include "bench/html.h"
#include "bench/join.h"
#include "bench/json.h"
#include "bench/presets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <string>

namespace froxel::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::ordered_json;

// A smoke run whose every frame takes `frame_us`, give or take 1 %; its last row was left out.
RunResult result(double frame_us) {
    RunResult result;
    result.scene_source = "builtin";
    result.device.kind = "gpu";
    result.base.views = {{"Nave", {}, 0}, {"Arcade", {}, 5}};
    SweepResult found{makeSweep("smoke", result.base), {}};
    found.rows.resize(found.sweep.rows.size());
    for (auto& row : found.rows) {
        for (int frame = 0; frame < 40; ++frame) {
            const double time_us = frame_us * (1 + 0.01 * (frame % 5 - 2));
            row.times.gpu_us.push_back(time_us);
            row.times.host_us.push_back(time_us / 2);
            row.times.frame_us.push_back(time_us * 2);
            row.times.cpu_us.push_back(time_us * 3);
        }
        row.times.passes = {{"light", 40, row.times.gpu_us}};
        row.errors.r1.size = {96, 54};
        row.errors.r1.view = 1;
        row.errors.r1.view_count = 2;
        row.errors.r2 = row.errors.r1;
        row.errors.r2.linear.max_abs = 0.25;
        row.errors.r2.linear.differing_count = 9;
    }
    found.rows.back().times = {};
    found.rows.back().times.skipped = "too slow";
    result.sweeps = {found};
    result.complete = true;
    return result;
}

Json reportOf(const RunResult& run) {
    return runReport(run, [](const Row& row, size_t frame_count) {
        return row.label + " in " + std::to_string(frame_count);
    });
}

std::vector<std::string> fieldsOf(const Json& object) {
    std::vector<std::string> fields;
    for (const auto& [field, value] : object.items()) {
        fields.push_back(field);
    }
    return fields;
}

TEST(RunReport, Top_HasTheSchemasFields) {
    const auto report = reportOf(result(100));
    EXPECT_THAT(fieldsOf(report),
                ElementsAre("schema", "froxel", "date", "complete", "elapsed_s", "device", "host",
                            "build", "scene", "method", "views", "sweeps", "published"));
    EXPECT_EQ(report["schema"], "froxel.bench.v1");
    EXPECT_EQ(report["method"]["error_size"], Json({640, 360}));
    EXPECT_EQ(report["views"][1]["time_s"], 5);
    const auto& sweep = report["sweeps"][0];
    EXPECT_THAT(fieldsOf(sweep), ElementsAre("name", "title", "variable", "unit", "axis", "about",
                                             "rows", "skipped"));
    EXPECT_EQ(sweep["axis"], "category");
}

TEST(RunReport, Row_HasTheSchemasFields) {
    const auto row = reportOf(result(100))["sweeps"][0]["rows"][1];
    EXPECT_THAT(fieldsOf(row),
                testing::UnorderedElementsAre(
                    "label", "series", "value", "workload", "settings", "scaled_to", "command",
                    "frames", "gpu_us", "host_us", "frame_us", "cpu_us", "passes", "samples",
                    "kept", "triangles", "draws", "grid", "light_lists", "pairs", "peel", "plan",
                    "memory_bytes", "gbuffer_bytes_per_pixel", "error_r1", "error_r2", "stream",
                    "note"));
    EXPECT_EQ(row["label"], "forward_plus");
    EXPECT_EQ(row["frames"], 40);
    EXPECT_EQ(row["gpu_us"]["median"], 100);
    EXPECT_EQ(row["gpu_us"]["p5"], 98);
    EXPECT_EQ(row["samples"]["gpu_us"][1], 990);
    EXPECT_EQ(row["passes"][0]["frames"], 40);
    EXPECT_EQ(row["workload"], "30 lights of 2 m, 96x54, pbr, Nave");
    EXPECT_EQ(row["settings"]["renderer"], "forward_plus");
    EXPECT_EQ(row["command"], "forward_plus in 40");
}

TEST(RunReport, TimesThatTheDriverDoesNotTell_AreNull) {
    auto run = result(100);
    run.device.kind = "cpu";
    for (auto& row : run.sweeps[0].rows) {
        row.times.gpu_us.clear();
        row.times.passes = {{"light", 40, {}}};
    }
    const auto report = reportOf(run);
    const auto row = report["sweeps"][0]["rows"][1];
    EXPECT_TRUE(row["gpu_us"].is_null());
    EXPECT_EQ(row["samples"]["gpu_us"], Json::array());
    EXPECT_EQ(row["passes"][0]["frames"], 40);
    EXPECT_TRUE(row["passes"][0]["gpu_us"].is_null());
    EXPECT_EQ(row["cpu_us"]["median"], 300);
    EXPECT_TRUE(compareReports(report, report));
}

TEST(RunReport, Errors_AreTheWorstViewsOrAReason) {
    auto run = result(100);
    run.sweeps[0].rows[1].errors.r2.skipped = "too many lights";
    const auto rows = reportOf(run)["sweeps"][0]["rows"];
    EXPECT_EQ(rows[0]["error_r1"]["exact"], true);
    EXPECT_EQ(rows[0]["error_r1"]["view"], "Arcade");
    EXPECT_EQ(rows[0]["error_r2"]["exact"], false);
    EXPECT_EQ(rows[0]["error_r2"]["linear"]["max_abs"], 0.25);
    EXPECT_EQ(rows[1]["error_r2"]["skipped"], "too many lights");
    EXPECT_TRUE(rows[1]["error_r2"]["linear"].is_null());
    EXPECT_EQ(fieldsOf(rows[0]["error_r2"]), fieldsOf(rows[1]["error_r2"]));
}

TEST(RunReport, RowLeftOut_IsThereWithItsReason) {
    const auto sweep = reportOf(result(100))["sweeps"][0];
    ASSERT_EQ(sweep["skipped"].size(), 1U);
    EXPECT_EQ(sweep["skipped"][0]["reason"], "too slow");
    EXPECT_EQ(sweep["skipped"][0]["label"], "JPEG");
}

TEST(RunReport, Published_NamesHardwareAndComputesTimes) {
    const auto report = reportOf(result(100));
    bool found = false;
    for (const auto& line : report["published"]) {
        EXPECT_FALSE(line["hardware"].get<std::string>().empty());
        EXPECT_FALSE(line["rows"].empty());
        for (const auto& row : line["rows"]) {
            EXPECT_FALSE(row["published"].get<std::string>().empty());
        }
        if (line["sweep"] == "light_count" && line["series"] == "naive" && !found) {
            found = true;
            EXPECT_EQ(line["rows"][0]["published"], "29 FPS");
            EXPECT_NEAR(line["rows"][0]["ms"].get<double>(), 34.48, 0.01);
        }
    }
    EXPECT_TRUE(found);
}

TEST(InexactRows, OnlyRowsThatDifferOrAreNotFinite_AreNamed) {
    auto run = result(100);
    EXPECT_THAT(inexactRows(run), IsEmpty());
    run.sweeps[0].rows[2].errors.r1.linear.nonfinite_count = 1;
    run.sweeps[0].rows[4].errors.r1.linear.differing_count = 3;
    run.sweeps[0].rows[5].errors.r1.skipped = "no time";
    const auto lines = inexactRows(run);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_THAT(lines[0], HasSubstr("smoke: clustered_deferred, clustered_deferred"));
    EXPECT_THAT(lines[1], HasSubstr("toon_compute"));
    EXPECT_THAT(lines[1], HasSubstr("in 3 pixels"));
}

TEST(CompareReports, WithItself_NothingDiffers) {
    const auto report = reportOf(result(100));
    const auto comparison = compareReports(report, report).value();
    EXPECT_EQ(comparison.measure, "gpu_us");
    EXPECT_EQ(comparison.rows.size(), 12U);
    EXPECT_THAT(comparison.warnings, IsEmpty());
    EXPECT_THAT(comparison.only_a, IsEmpty());
    EXPECT_FALSE(comparison.worse());
}

TEST(CompareReports, TenPercentSlower_IsWorseAndTheOtherWayFaster) {
    const auto before = reportOf(result(100));
    const auto after = reportOf(result(110));
    const auto slower = compareReports(before, after).value();
    EXPECT_TRUE(slower.worse());
    EXPECT_TRUE(slower.rows[0].slower);
    EXPECT_EQ(slower.rows[0].median_b_us, 110);
    const auto faster = compareReports(after, before).value();
    EXPECT_FALSE(faster.worse());
    EXPECT_TRUE(faster.rows[0].faster);
    EXPECT_THAT(toText(slower), HasSubstr("12 rows: 12 slower, 0 faster"));
}

TEST(CompareReports, LargerError_IsWorseAndNamed) {
    const auto before = reportOf(result(100));
    auto run = result(100);
    run.sweeps[0].rows[0].errors.r2.perceived.flip = 0.2;
    const auto comparison = compareReports(before, reportOf(run)).value();
    EXPECT_TRUE(comparison.worse());
    EXPECT_THAT(toText(comparison), HasSubstr("R2 FLIP 0 to 0.2"));
    EXPECT_FALSE(compareReports(reportOf(run), before).value().worse());
}

TEST(CompareReports, OtherSettings_AreRowsOfOneSideAndOtherDevicesAWarning) {
    auto run = result(100);
    run.device.kind = "cpu";
    run.sweeps[0].sweep.rows[0].settings.lights.count = 31;
    const auto comparison = compareReports(reportOf(result(100)), reportOf(run)).value();
    EXPECT_EQ(comparison.only_a.size(), 1U);
    EXPECT_EQ(comparison.only_b.size(), 1U);
    EXPECT_EQ(comparison.warnings.size(), 1U);
    EXPECT_EQ(comparison.measure, "cpu_us");
    EXPECT_THAT(toText(comparison), HasSubstr("only in a: smoke: naive, naive"));
}

// An older report knows less of the same frames.
TEST(CompareReports, SettingsThatOneDoesNotTell_AreAWarningNotAnotherRow) {
    const auto newer = reportOf(result(100));
    auto older = newer;
    for (auto& row : older["sweeps"][0]["rows"]) {
        row["settings"].erase("debug_view");
        row["settings"]["lights"].erase("speed");
    }
    const auto comparison = compareReports(older, newer).value();
    EXPECT_TRUE(comparison.only_a.empty());
    EXPECT_TRUE(comparison.only_b.empty());
    EXPECT_EQ(comparison.rows.size(), newer["sweeps"][0]["rows"].size());
    ASSERT_EQ(comparison.warnings.size(), 1U);
    EXPECT_EQ(comparison.warnings[0],
              "only in one result, with its default: debug_view, lights.speed");
    auto other = result(100);
    for (auto& row : other.sweeps[0].sweep.rows) {
        row.settings.lights.box = BoundsD3{{0, 0, 0}, {1, 1, 1}};
    }
    EXPECT_TRUE(compareReports(newer, reportOf(other)).value().rows.empty());
    other = result(100);
    for (auto& row : other.sweeps[0].sweep.rows) {
        row.settings.fog.density = 0.5F;
    }
    EXPECT_TRUE(compareReports(newer, reportOf(other)).value().rows.empty());
}

TEST(CompareReports, OtherFiles_AreRefused) {
    const auto report = reportOf(result(100));
    EXPECT_THAT(compareReports(report, Json::array()).error().message, HasSubstr("second"));
    EXPECT_THAT(compareReports({{"schema", 7}}, report).error().message, HasSubstr("first"));
    auto broken = report;
    broken["sweeps"][0]["rows"][0].erase("samples");
    EXPECT_THAT(compareReports(broken, report).error().message, HasSubstr("samples"));
    broken = report;
    broken["sweeps"][0]["rows"][0]["samples"]["gpu_us"] = Json::array();
    EXPECT_TRUE(compareReports(broken, report).has_error());
}

TEST(JoinReports, PartsOfOneRun_AreOne) {
    auto a = reportOf(result(100));
    auto b = a;
    b["date"] = "2026-11-02T00:00:00Z";
    b["sweeps"][0]["name"] = "other";
    b["complete"] = false;
    const auto joined = joinReports(std::vector{a, b}).value();
    ASSERT_EQ(joined["sweeps"].size(), 2U);
    EXPECT_EQ(joined["sweeps"][0], a["sweeps"][0]);
    EXPECT_EQ(joined["sweeps"][1], b["sweeps"][0]);
    EXPECT_EQ(joined["complete"], false);
    EXPECT_EQ(joined["elapsed_s"], 2 * a["elapsed_s"].get<double>());
    EXPECT_EQ(joined["date"], a["date"]);
    EXPECT_EQ(joinReports(std::vector{a}).value()["sweeps"], a["sweeps"]);
}

TEST(JoinReports, WhatDoesNotBelongTogether_IsRefusedByName) {
    const auto a = reportOf(result(100));
    const auto textOf = [&](const Json& b) {
        return joinReports(std::vector{a, b}).error().message;
    };
    EXPECT_THAT(textOf(a), HasSubstr("\"smoke\" is there twice"));
    auto other = a;
    other["device"]["name"] = "another";
    EXPECT_EQ(textOf(other), "file 2: its device is not that of file 1");
    EXPECT_THAT(textOf(Json::array()), HasSubstr("file 2: not a result"));
    other = a;
    other["sweeps"][0].erase("name");
    EXPECT_THAT(textOf(other), HasSubstr("has no name"));
}

TEST(FillReport, TextsThatEndScripts_CannotAndReadBackTheSame) {
    const Json report = {{"scene", "</script><!--<script>\u2028 & 'x'"}};
    const std::string place(kResultsPlace);
    const auto page = fillReport("<body>" + place + "<p>end", report).value();
    const std::string head = R"(<body><script type="application/json" id="results">)";
    const std::string tail = "</script><p>end";
    ASSERT_TRUE(page.starts_with(head) && page.ends_with(tail)) << page;
    const auto json = page.substr(head.size(), page.size() - head.size() - tail.size());
    EXPECT_EQ(json.find('<'), std::string::npos);
    EXPECT_EQ(Json::parse(json), report);
}

TEST(FillReport, NoPlaceOrTwo_IsRefused) {
    const std::string place(kResultsPlace);
    EXPECT_TRUE(fillReport("<body>", {}).has_error());
    EXPECT_TRUE(fillReport(place + place, {}).has_error());
}

} // namespace
} // namespace froxel::bench
