#include "load/requirement.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace froxel::load {
namespace {

// Latencies of `base_ms` to `base_ms` + 99, 50 frames a second for 2 s.
ViewerResult viewer(double base_ms) {
    ViewerResult result;
    result.tried = true;
    result.first_frame_ms = base_ms + 120;
    result.received_bytes = 1'000'000;
    Measured& measured = result.measured;
    measured.seconds = 2;
    measured.frames = 100;
    measured.errors = 2;
    for (int index = 0; index < 100; ++index) {
        measured.samples.latency_ms.push_back(base_ms + index);
        measured.samples.interval_ms.push_back(index < 98 ? 20 : 50);
    }
    return result;
}

ViewerResult failed(bool refused) {
    ViewerResult result;
    result.tried = true;
    result.failure = "why";
    result.refused = refused;
    return result;
}

Outcome outcome(const std::string& text, std::vector<ViewerResult> viewers) {
    const RunResult run{std::move(viewers), 2, false, false};
    return check(parseRequirements(text).value(), run).at(0);
}

TEST(Requirement, SampleFigure_PoolsAllViewers_OrTakesEachOnesStatistic) {
    EXPECT_EQ(outcome("latency.p95<500", {viewer(0), viewer(100)}).measured, 189);
    EXPECT_EQ(outcome("latency.p95.max<500", {viewer(0), viewer(100)}).measured, 194);
    EXPECT_EQ(outcome("latency.p95.min<500", {viewer(0), viewer(100)}).measured, 94);
    EXPECT_EQ(outcome("latency.p99.5<500", {viewer(0)}).measured, 99)
        << "a percentile with a point";
    EXPECT_EQ(outcome("latency.median<500", {viewer(0)}).measured, 49.5);
    EXPECT_EQ(outcome("latency.mean<500", {viewer(0)}).measured, 49.5);
    EXPECT_EQ(outcome("latency.max<500", {viewer(0)}).measured, 99);
    EXPECT_EQ(outcome("interval.p100<500", {viewer(0)}).measured, 50);
}

TEST(Requirement, ViewerFigure_IsTheWorstViewers_AsTheComparisonTells) {
    auto slow = viewer(0);
    slow.measured.frames = 10;
    EXPECT_EQ(outcome("fps>=30", {viewer(0), slow}).measured, 5);
    EXPECT_EQ(outcome("fps<=30", {viewer(0), slow}).measured, 50);
    EXPECT_EQ(outcome("fps.mean>=30", {viewer(0), slow}).measured, 27.5);
    EXPECT_EQ(outcome("mbps<5", {viewer(0)}).measured, 4);
    EXPECT_EQ(outcome("jitter<5", {viewer(0)}).measured, 30);
    EXPECT_EQ(outcome("first_frame<5", {viewer(0), viewer(7)}).measured, 127);
    auto waiting = failed(false);
    waiting.first_frame_wait_ms = 500;
    EXPECT_EQ(outcome("first_frame<5", {viewer(0), waiting}).measured, 500) << "none came so far";
}

TEST(Requirement, RunFigures_CountViewersAndErrors) {
    const std::vector<ViewerResult> viewers{viewer(0), failed(true), failed(true), failed(false)};
    EXPECT_EQ(outcome("refused<=50%", viewers).measured, 0.5);
    EXPECT_TRUE(outcome("refused<=50%", viewers).held);
    EXPECT_FALSE(outcome("refused<50%", viewers).held);
    EXPECT_EQ(outcome("failed<=0.1", viewers).measured, 0.25);
    EXPECT_EQ(outcome("refused<=1", {failed(true), ViewerResult{}}).measured, 1)
        << "one never came to try";
    EXPECT_EQ(outcome("errors<=0", viewers).measured, 2);
}

TEST(Requirement, NothingMeasured_IsNotHeld) {
    const auto none = outcome("latency.p95<1000", {failed(false)});
    EXPECT_EQ(none.measured, std::nullopt);
    EXPECT_FALSE(none.held);
    EXPECT_EQ(wordsOf(none), "latency.p95<1000: no sample");
    EXPECT_FALSE(outcome("fps<1000", {failed(false)}).held);
}

TEST(Requirement, Comparisons_AreExactAtTheLimit) {
    EXPECT_FALSE(outcome("latency.max<99", {viewer(0)}).held);
    EXPECT_TRUE(outcome("latency.max<=99", {viewer(0)}).held);
    EXPECT_FALSE(outcome("fps>50", {viewer(0)}).held);
    EXPECT_TRUE(outcome("fps>=50", {viewer(0)}).held);
}

TEST(Requirement, List_WithSpaces_IsReadWhole) {
    const auto list = parseRequirements("latency.p99 < 80, fps>=30,refused<=5%").value();
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0].text, "latency.p99<80");
    EXPECT_EQ(figureOf(list[2]), "refused");
    EXPECT_EQ(list[2].limit, 0.05);
    EXPECT_TRUE(namesFigure(list, "fps"));
    EXPECT_FALSE(namesFigure(list, "failed"));
}

TEST(Requirement, Faults_NameTheRequirementAndWhatWouldBeRight) {
    constexpr std::array kFaults = {
        std::pair{"", "expected FIGURE<NUMBER"},
        std::pair{"latency", "expected FIGURE<NUMBER"},
        std::pair{"latency=3", "expected FIGURE<NUMBER"},
        std::pair{"latncy.p95<3", "'latncy' is not a figure; expected one of latency, reaction"},
        std::pair{"latency<3", "'latency' needs a statistic, such as latency.p95"},
        std::pair{"latency.p101<3", "'p101' is not a statistic"},
        std::pair{"latency.p0<3", "'p0' is not a statistic"},
        std::pair{"latency.pnan<3", "'pnan' is not a statistic"},
        std::pair{"latency.p95.max.min<3", "has 3 statistics; expected 2 or fewer"},
        std::pair{"errors.max<3", "has 1 statistics; expected 0 or fewer"},
        std::pair{"fps>=", "'' is not a number"},
        std::pair{"fps>=nan", "'nan' is not a number"},
        std::pair{"fps>=inf", "'inf' is not a number"},
        std::pair{"fps>=-3", "'-3' is not a number from 0"},
        std::pair{"fps>=30,", "expected FIGURE<NUMBER"},
        std::pair{"fps.<3", "'' is not a statistic"}};
    for (const auto& [text, words] : kFaults) {
        const auto parsed = parseRequirements(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(parsed.error().message.find(words), std::string::npos) << parsed.error().message;
    }
}

// 60 frames a second for 10 s, then none for 20 s.
TEST(Stall, IsHowLongMoreThanATwentiethOfTheTimeWaited) {
    Measured frozen;
    frozen.seconds = 30;
    frozen.samples.interval_ms.assign(600, 1000.0 / 60);
    frozen.samples.interval_ms.push_back(20'000);
    EXPECT_NEAR(stallMs(frozen), 18'500, 1e-6);
    EXPECT_NEAR(stallMs(viewer(0).measured), 19.6, 1e-9) << "0.1 of 2 s lies beyond it";
    EXPECT_EQ(stallMs({}), 0);
}

} // namespace
} // namespace froxel::load
