#include "report/frame_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace froxel::report {
namespace {

TEST(FrameReport, WhatAFrameDoesNotHave_IsNullOrEmpty) {
    const auto report = frameReport({});
    EXPECT_TRUE(report["grid"].is_null());
    EXPECT_TRUE(report["pairs"].is_null());
    EXPECT_TRUE(report["peel"].is_null());
    EXPECT_FALSE(report.contains("metered_ev"));
    EXPECT_TRUE(report["plan"].empty());
    EXPECT_TRUE(report["memory_bytes"].is_object());
}

TEST(FrameReport, GridListsPairsPlanAndMemory_AreThere) {
    FrameStats stats;
    stats.grid = {30, 17, 32, 64, 60, 0.25, 40, true, "cheapest"};
    stats.lists.p95 = 88;
    stats.lists.why = "lists pay";
    static constexpr StatRow kContributing{"pairs", "contributing", "contributing"};
    static constexpr StatRow kOverflow{"peel", "overflow_pixels", "overflow_pixels"};
    static constexpr StatRow kMetered{"", "metered_ev", "metered_ev", false};
    stats.steps.set(kContributing, 25);
    stats.steps.set(kOverflow, 9);
    stats.steps.set(kMetered, 1.5);
    stats.details =
        std::make_shared<const FrameDetails>(FrameDetails{{"no masks"}, {{"textures", 7}}, {}});
    const auto report = frameReport(stats);
    EXPECT_EQ(report["grid"]["size"], nlohmann::json({30, 17, 32}));
    EXPECT_EQ(report["grid"]["why"], "cheapest");
    EXPECT_EQ(report["light_lists"]["p95"], 88);
    EXPECT_EQ(report["light_lists"]["why"], "lists pay");
    EXPECT_EQ(report["pairs"].dump(), R"({"contributing":25})") << "a count has no fraction";
    EXPECT_EQ(report["peel"]["overflow_pixels"], 9);
    EXPECT_EQ(report["metered_ev"], 1.5);
    EXPECT_EQ(report["plan"][0], "no masks");
    EXPECT_EQ(report["memory_bytes"]["textures"], 7);
}

} // namespace
} // namespace froxel::report
