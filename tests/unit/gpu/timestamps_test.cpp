#include "gpu/timestamps.h"

#include <gtest/gtest.h>

#include <array>

namespace froxel::gpu {
namespace {

using Time = std::optional<double>;

struct Written {
    const char* name;
    uint64_t begin;
    uint64_t end;
};

// By a clock of half a microsecond.
FrameStats timesOf(std::initializer_list<Written> passes, bool cut = false) {
    std::vector<std::string> names;
    std::vector<uint64_t> ticks;
    for (const Written& pass : passes) {
        names.emplace_back(pass.name);
        ticks.insert(ticks.end(), {pass.begin, pass.end});
    }
    FrameStats stats;
    addTimes(names, ticks, 0.5, cut, stats);
    return stats;
}

TEST(Timestamps, PartsOfOneName_AreAddedUp) {
    const auto parts = {Written{"a", 100, 110}, {"b", 110, 140}, {"a", 150, 156}};
    const auto whole = timesOf(parts);
    ASSERT_EQ(whole.passes.size(), 2U);
    EXPECT_EQ(whole.passes[0].name, "a");
    EXPECT_EQ(whole.passes[0].gpu_us, Time(8));
    EXPECT_EQ(whole.passes[1].gpu_us, Time(15));
    EXPECT_EQ(whole.gpu_us, Time(28));                // from 100 to 156
    EXPECT_EQ(timesOf(parts, true).gpu_us, Time(23)); // without the pauses between
}

TEST(Timestamps, PassOfNoTime_IsKnownToTakeNone) {
    EXPECT_EQ(timesOf({{"a", 100, 100}}).passes[0].gpu_us, Time(0));
}

TEST(Timestamps, NotWritten_MakeUnknownWhatNeedsThem) {
    for (const Written& lost : {Written{"b", 0, 0}, {"b", 0, 140}, {"b", 110, 0}}) {
        const auto passes = {Written{"a", 100, 110}, lost, {"c", 150, 156}};
        const auto whole = timesOf(passes);
        EXPECT_EQ(whole.passes[0].gpu_us, Time(5));
        EXPECT_EQ(whole.passes[1].gpu_us, std::nullopt);
        EXPECT_EQ(whole.passes[2].gpu_us, Time(3));
        EXPECT_EQ(whole.gpu_us, Time(28));
        EXPECT_EQ(timesOf(passes, true).gpu_us, std::nullopt);
    }
    EXPECT_EQ(timesOf({{"a", 0, 110}, {"b", 110, 120}}).gpu_us, std::nullopt);
    EXPECT_EQ(timesOf({{"a", 100, 110}, {"b", 110, 0}}).gpu_us, std::nullopt);
}

TEST(Timestamps, PartNotWritten_MakesItsPassUnknown) {
    for (const auto& parts : {std::array{Written{"a", 0, 0}, Written{"a", 150, 156}},
                              std::array{Written{"a", 100, 110}, Written{"a", 150, 0}}}) {
        const auto stats = timesOf({parts[0], parts[1]});
        ASSERT_EQ(stats.passes.size(), 1U);
        EXPECT_EQ(stats.passes[0].gpu_us, std::nullopt);
    }
}

TEST(Timestamps, EndBeforeTheBegin_IsNoTime) {
    EXPECT_EQ(timesOf({{"a", 110, 100}}).passes[0].gpu_us, std::nullopt);
}

} // namespace
} // namespace froxel::gpu
