#include "app/info_report.h"
#include "app/timings_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <vector>

namespace froxel::app {
namespace {

FrameStats frameOf(std::vector<PassTime> passes, double frame_us) {
    FrameStats stats;
    stats.passes = std::move(passes);
    stats.frame_us = frame_us;
    return stats;
}

TEST(TimingsReport, PassInSomeFrames_CountsThose) {
    TimedRun run;
    run.frames = {frameOf({{"depth", 10}, {"light", 30}}, 50),
                  frameOf({{"depth", 20}, {"glass", 5}, {"light", 40}}, 70)};
    const auto report = timingsReport(run);
    EXPECT_EQ(report["frames"], 2);
    EXPECT_EQ(report["frame"]["frame_us"]["median"], 60);
    ASSERT_EQ(report["passes"].size(), 3U);
    EXPECT_EQ(report["passes"][0]["name"], "depth");
    EXPECT_EQ(report["passes"][0]["frames"], 2);
    EXPECT_EQ(report["passes"][0]["gpu_us"]["max"], 20);
    EXPECT_EQ(report["passes"][1]["name"], "light");
    EXPECT_EQ(report["passes"][2]["name"], "glass");
    EXPECT_EQ(report["passes"][2]["frames"], 1);
}

TEST(TimingsReport, TimesThatTheDriverDoesNotTell_AreNull) {
    TimedRun run;
    run.frames = {frameOf({{"depth", 10}, {"light", std::nullopt}}, 50)};
    const auto report = timingsReport(run);
    EXPECT_TRUE(report["frame"]["gpu_us"].is_null());
    EXPECT_EQ(report["frame"]["frame_us"]["median"], 50);
    EXPECT_EQ(report["passes"][0]["gpu_us"]["median"], 10);
    EXPECT_EQ(report["passes"][1]["frames"], 1);
    EXPECT_TRUE(report["passes"][1]["gpu_us"].is_null());
}

TEST(TimingsReport, Settings_AreRecorded) {
    TimedRun run;
    run.frames.resize(1);
    run.settings.renderer = settings::Renderer::kForwardPlus;
    run.settings.camera = settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0});
    run.settings.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    const auto settings = timingsReport(run)["settings"];
    EXPECT_EQ(settings["renderer"], "forward_plus");
    EXPECT_EQ(settings["camera"]["eye"], nlohmann::json({-7.0, 2.0, 0.0}));
    EXPECT_EQ(settings["camera"]["target"], nlohmann::json({0.0, 2.0, 0.0}));
    EXPECT_EQ(settings["lights"]["box_m"]["max"], nlohmann::json({10.0, 8.0, 5.0}));
    EXPECT_EQ(settings["grid"], "auto");
    EXPECT_EQ(settings["shading"], "pbr");
    EXPECT_EQ(settings["gbuffer"]["normal"], "oct16");
    run.settings.grid.automatic = false;
    EXPECT_EQ(timingsReport(run)["settings"]["grid"], nlohmann::json({16, 9, 24}));
}

scene::Scene triangleTwice() {
    scene::Scene scene;
    scene.name = "twins";
    scene.materials.resize(1);
    scene::Primitive triangle;
    triangle.positions.resize(3);
    triangle.normals.resize(3);
    triangle.indices = {0, 1, 2};
    scene.meshes = {{"triangle", {triangle}}};
    scene.instances.resize(2);
    scene.images = {{"red", 2, 2, std::vector<std::byte>(16)}};
    scene.lights.resize(1);
    scene.lights[0].type = scene::LightType::kSpot;
    return scene;
}

TEST(SceneReport, InstancesCountEach_GeometryOnce) {
    const auto report = sceneReport(triangleTwice());
    EXPECT_EQ(report["triangles"], 2);
    EXPECT_EQ(report["draws"], 2);
    EXPECT_EQ(report["geometry_bytes"], 3 * (12 + 12 + 4));
    EXPECT_EQ(report["texture_bytes"], 16);
    EXPECT_EQ(report["lights"]["spot"], 1);
    EXPECT_EQ(report["lights"]["point"], 0);
    EXPECT_TRUE(report["bounds_m"].is_null());
    EXPECT_FALSE(report["needs"].empty());
}

TEST(SceneReport, Warnings_HaveTheValidatorsShape) {
    scene::Scene scene = triangleTwice();
    scene.warnings = {
        {"SCENE_NON_ROOT_NODE", scene::Severity::kInformation, "/scenes/0/nodes", "lists a child"}};
    scene.warnings_left_out = 3;
    const auto report = sceneReport(scene);
    EXPECT_EQ(report["warnings"], nlohmann::ordered_json::parse(R"([{"code": "SCENE_NON_ROOT_NODE",
        "severity": 2, "pointer": "/scenes/0/nodes", "message": "lists a child"}])"));
    EXPECT_EQ(report["warnings_left_out"], 3);
}

TEST(ToText, ObjectsOfAList_AreALineEach) {
    const nlohmann::ordered_json report = {
        {"warnings", {{{"code", "A_B"}, {"severity", 1}, {"message", "what it is"}}}}};
    EXPECT_EQ(toText(report), "warnings:\n  - A_B 1 what it is\n");
}

TEST(ToText, NestedReport_IsIndentedLines) {
    const nlohmann::ordered_json report = {{"device", {{"name", "box"}, {"size", 3}}},
                                           {"needs", {"a: yes", "b: no"}}};
    EXPECT_EQ(toText(report), "device:\n  name: box\n  size: 3\nneeds:\n  - a: yes\n  - b: no\n");
}

} // namespace
} // namespace froxel::app
