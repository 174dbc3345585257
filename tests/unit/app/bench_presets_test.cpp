#include "app/bench_budget.h"
#include "app/bench_errors.h"
#include "app/bench_json.h"
#include "app/bench_presets.h"
#include "app/light_set_file.h"
#include "app/render_arguments.h"
#include "session/placed_lights.h"
#include "support/setting_values.h"
#include "unit/app/parsed_options.h"
#include "view/ranges.h"
#include "view/setting_rows.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <set>
#include <tuple>

namespace froxel::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

BenchBase base() {
    BenchBase base;
    base.settings.lights.box = BoundsD3{{-10, 0, -5}, {10.1, 8, 5}};
    base.settings.lights.intensity = 0.7F;
    base.settings.lights.seed = 9;
    for (const char* name : {"-7,2,0;0,2,0.3;45", "Nave of 'Hall'"}) {
        base.views.push_back({name, view::lookAt({-7, 2, 0}, {0, 2, 0.3}, {0, 1, 0}),
                              static_cast<double>(base.views.size()) * 2.5});
    }
    base.views.front().camera.yfov_rad = glm::radians(45.0);
    return base;
}

std::vector<Sweep> everySweep() {
    std::vector<Sweep> sweeps;
    for (const auto name : benchPresetNames()) {
        sweeps.push_back(makeSweep(name, base()));
    }
    return sweeps;
}

std::vector<BenchRow> everyRow() {
    std::vector<BenchRow> rows;
    for (const auto& sweep : everySweep()) {
        rows.insert(rows.end(), sweep.rows.begin(), sweep.rows.end());
    }
    return rows;
}

TEST(BenchPresets, Full_AreAllButSmoke) {
    const auto full = fullBenchPresetNames();
    EXPECT_EQ(full.size() + 1, benchPresetNames().size());
    EXPECT_EQ(std::ranges::count(full, "smoke"), 0);
    EXPECT_EQ(benchPresetNames().back(), "smoke");
}

TEST(BenchPresets, EverySweep_IsNamedByItsPresetAndHasRows) {
    for (const auto name : benchPresetNames()) {
        const auto sweep = makeSweep(name, base());
        EXPECT_EQ(sweep.name, name);
        EXPECT_GE(sweep.rows.size(), 3U) << name;
        EXPECT_FALSE(sweep.title.empty()) << name;
        EXPECT_FALSE(sweep.variable.empty()) << name;
    }
}

TEST(BenchPresets, EveryRow_IsInRange) {
    for (const auto& row : everyRow()) {
        const auto& s = row.settings;
        EXPECT_TRUE(view::kWidthRange.contains(s.size.width_px)) << row.label;
        EXPECT_TRUE(view::kHeightRange.contains(s.size.height_px)) << row.label;
        for (const auto& setting : view::kSettingRows) {
            EXPECT_TRUE(test::accepts(setting, setting.get(s))) << setting.name << row.label;
        }
        EXPECT_TRUE(view::kGridXRange.contains(s.grid.size.x)) << row.label;
        EXPECT_TRUE(view::kGridYRange.contains(s.grid.size.y)) << row.label;
        EXPECT_TRUE(view::kGridZRange.contains(s.grid.size.z)) << row.label;
        EXPECT_LT(row.timedView(), base().views.size());
        if (row.stream) {
            EXPECT_TRUE(view::kQualityRange.contains(row.stream->quality)) << row.label;
        }
    }
}

TEST(BenchPresets, RowsOfASweep_AreDistinctAndASeriesHasOneRowAnX) {
    for (const auto& sweep : everySweep()) {
        std::set<std::pair<std::string, std::string>> names;
        std::set<std::pair<std::string, double>> places;
        for (const auto& row : sweep.rows) {
            EXPECT_TRUE(names.emplace(row.series, row.label).second)
                << sweep.name << " " << row.series << " " << row.label;
            // Grids of different shapes may have as many clusters.
            EXPECT_TRUE(places.emplace(row.series, row.value).second || sweep.name == "grid")
                << sweep.name << " " << row.series << " " << row.label;
        }
    }
}

TEST(BenchPresets, SeriesOfPredictableWork_AreInAscendingOrder) {
    for (const auto name : {"light_count", "resolution", "resolution_scale", "memory"}) {
        std::map<std::string, double> work;
        for (const auto& row : makeSweep(name, base()).rows) {
            const double now = workOf(row.settings);
            EXPECT_GE(now, work[row.series]) << name << " " << row.label;
            work[row.series] = now;
        }
    }
}

TEST(BenchPresets, LightCount_GoesToAMillionForEveryWay) {
    std::map<std::string, uint32_t> most;
    for (const auto& row : makeSweep("light_count", base()).rows) {
        most[row.series] = std::max(most[row.series], row.settings.lights.count);
    }
    EXPECT_EQ(most.size(), 5U);
    for (const auto& [series, count] : most) {
        EXPECT_EQ(count, 1'000'000U) << series;
    }
}

TEST(BenchPresets, Renderer_HasAllFiveInBothStages) {
    std::set<std::pair<view::Renderer, view::LightingStage>> ways;
    for (const auto& row : makeSweep("renderer", base()).rows) {
        ways.emplace(row.settings.renderer, row.settings.lighting);
    }
    EXPECT_EQ(ways.size(), 2 * view::kRendererNames.size());
}

TEST(BenchPresets, ResolutionScale_IsScaledToTheBase) {
    for (const auto& row : makeSweep("resolution_scale", base()).rows) {
        EXPECT_EQ(row.scaled_to, view::Size{});
        EXPECT_EQ(row.settings.size.width_px, row.value * 1280) << row.label;
    }
}

// What the row's command line says.
RenderOptions parsedCommand(const BenchResult& result, const BenchRow& row) {
    RenderOptions options;
    options.scene = result.scene_source;
    options.device.choice = result.device_choice;
    options.settings = row.settings;
    options.time_s = result.base.views[row.timedView()].time_s;
    options.frame_count = 40;
    options.timings = "timings.json";
    if (!row.light_set.empty()) {
        options.light_set = std::filesystem::path(testing::TempDir()) / row.light_set;
        std::ofstream(options.light_set) << session::lightSetJson(row.settings.lights.placed);
    }
    return parsedBack(options, result.base.views[row.timedView()].name);
}

TEST(RenderArguments, EveryRow_ParsesBackToItsSettings) {
    BenchResult result;
    result.scene_source = "my scene.gltf";
    result.device_choice = gpu::DeviceChoice::kCpu;
    result.base = base();
    for (const auto& row : everyRow()) {
        const auto parsed = parsedCommand(result, row);
        auto settings = parsed.settings;
        const auto& view = result.base.views[row.timedView()];
        settings.camera = row.settings.camera; // chosen apart from the settings
        EXPECT_EQ(settings, row.settings) << row.series << ", " << row.label;
        EXPECT_EQ(parsed.scene, result.scene_source);
        EXPECT_EQ(parsed.device.choice, result.device_choice);
        EXPECT_EQ(parsed.time_s, view.time_s);
        EXPECT_EQ(parsed.frame_count, 40U);
        if (const auto* camera = std::get_if<view::Camera>(&parsed.camera)) {
            EXPECT_EQ(*camera, std::get<view::Camera>(parseCamera(view.name).value()));
        } else {
            EXPECT_EQ(std::get<std::string>(parsed.camera), view.name);
        }
    }
}

TEST(ShellCommand, WhatAShellWouldRead_IsQuoted) {
    EXPECT_EQ(
        shellCommand({"render", "--size", "64x36", "--camera", "-7,2,0;0,2,0;45", "it's", ""}),
        "froxel render --size 64x36 --camera '-7,2,0;0,2,0;45' 'it'\\''s' ''");
}

} // namespace
} // namespace froxel::app
