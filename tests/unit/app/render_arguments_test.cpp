#include "app/render_arguments.h"
#include "app/row_command.h"
#include "session/placed_lights.h"
#include "unit/app/parsed_options.h"
#include "unit/bench/every_row.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <variant>

namespace froxel::app {
namespace {

constexpr const char* kScene = "my scene.gltf";

// What the row's command line says.
RenderOptions parsedCommand(const bench::Base& base, const bench::Row& row) {
    const auto& view = base.views[row.timedView()];
    RenderOptions options;
    options.scene = kScene;
    options.device.choice = gpu::DeviceChoice::kCpu;
    options.settings = row.settings;
    options.time_s = view.time_s;
    options.frame_count = 40;
    options.keep_surfaces = true;
    options.timings = "timings.json";
    if (!row.light_set.empty()) {
        options.light_set = std::filesystem::path(testing::TempDir()) / row.light_set;
        std::ofstream(options.light_set) << session::lightSetJson(row.settings.lights.placed);
    }
    return parsedBack(options, view.name);
}

TEST(RenderArguments, EveryRow_ParsesBackToItsSettings) {
    const auto base = bench::base();
    for (const auto& row : bench::everyRow()) {
        const auto parsed = parsedCommand(base, row);
        auto settings = parsed.settings;
        const auto& view = base.views[row.timedView()];
        settings.camera = row.settings.camera; // chosen apart from the settings
        EXPECT_EQ(settings, row.settings) << row.series << ", " << row.label;
        EXPECT_EQ(parsed.scene, kScene);
        EXPECT_EQ(parsed.device.choice, gpu::DeviceChoice::kCpu);
        EXPECT_EQ(parsed.time_s, view.time_s);
        EXPECT_EQ(parsed.frame_count, 40U);
        EXPECT_TRUE(parsed.keep_surfaces);
        if (const auto* camera = std::get_if<settings::Camera>(&parsed.camera)) {
            EXPECT_EQ(*camera, std::get<settings::Camera>(parseCamera(view.name).value()));
        } else {
            EXPECT_EQ(std::get<std::string>(parsed.camera), view.name);
        }
    }
}

TEST(RowCommand, Row_IsDrawnAsItWasTimed) {
    BenchOptions options;
    options.scene = "my scene.gltf";
    options.environment_file = "sky.hdr";
    options.light_set = "placed.json";
    bench::RunResult result;
    result.base = bench::base();
    result.budget.warmup_first = 7;
    bench::Row row;
    row.settings.lights.count = 12;
    row.only_view = 0;
    EXPECT_EQ(
        rowCommand(options, result, row, 40),
        "froxel render --scene 'my scene.gltf' --environment-file sky.hdr --device auto "
        "--camera '-7,2,0;0,2,0.3;45' "
        "--size 1280x720 --look none --renderer clustered_deferred --lights 12 --light-radius 2 "
        "--light-intensity 1 --environment off --exposure-mode fixed "
        "--light-set placed.json --frames 40 --warmup 7 --timings timings.json");
    row.only_view = 1;
    row.light_set = "own.json";
    EXPECT_THAT(rowCommand(options, result, row, 40),
                testing::HasSubstr("--light-set own.json --time 2.5 "));
}

TEST(ShellCommand, WhatAShellWouldRead_IsQuoted) {
    EXPECT_EQ(
        shellCommand({"render", "--size", "64x36", "--camera", "-7,2,0;0,2,0;45", "it's", ""}),
        "froxel render --size 64x36 --camera '-7,2,0;0,2,0;45' 'it'\\''s' ''");
}

} // namespace
} // namespace froxel::app
