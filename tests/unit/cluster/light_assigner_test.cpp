// Lists as a whole: counts around every word width, reuse, threads and the limit.
#include "assign_cases.h"
#include "cluster/light_assigner.h"

#include <numeric>

namespace froxel::cluster::testing {
namespace {

light::FrameLights scattered(size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    light::FrameLights lights;
    for (size_t i = 0; i < count; ++i) {
        addPoint(lights, {10 * unit(random), 5 * unit(random), -15 + 16 * unit(random)}, 2);
    }
    return lights;
}

ClusterGrid usualGrid() {
    return makeClusterGrid({16, 9, 24}, {1280, 720}, perspective(45), 0.5, 35);
}

void expectSame(const LightLists& a, const LightLists& b) {
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    for (size_t i = 0; i < a.clusters.size(); ++i) {
        ASSERT_EQ(a.clusters[i].offset, b.clusters[i].offset);
        ASSERT_EQ(a.clusters[i].count, b.clusters[i].count);
    }
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.all_lights, b.all_lights);
    EXPECT_EQ(a.stats.entry_count, b.stats.entry_count);
    EXPECT_EQ(a.stats.empty_count, b.stats.empty_count);
    EXPECT_EQ(a.stats.largest, b.stats.largest);
    EXPECT_EQ(a.stats.p95, b.stats.p95);
    EXPECT_EQ(a.stats.bytes, b.stats.bytes);
}

TEST(LightAssigner, Threads_DoNotChangeTheResult) {
    for (const size_t count : {0U, 1U, 255U, 256U, 257U, 3000U}) {
        const auto lights = scattered(count, 5);
        const LightLists one = assigned(usualGrid(), lights, 1);
        for (const unsigned threads : {2U, 3U, 8U}) {
            expectSame(one, assigned(usualGrid(), lights, threads));
        }
    }
}

// The largest grid there is, its lines in uneven shares; and one line.
TEST(LightAssigner, Threads_OnExtremeGrids_DoNotChangeTheResult) {
    const auto lights = scattered(1500, 6);
    for (const settings::GridSize size :
         {settings::GridSize{128, 128, 256}, {128, 1, 1}, {1, 128, 256}}) {
        const ClusterGrid grid = makeClusterGrid({size}, {1280, 720}, perspective(45), 0.5, 35);
        const LightLists one = assigned(grid, lights, 1);
        expectSame(one, assigned(grid, lights, 2));
        expectSame(one, assigned(grid, lights, 5));
    }
}

TEST(LightAssigner, AMillionSmallLights_AreAssigned) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    light::FrameLights lights;
    for (int i = 0; i < 1'000'000; ++i) {
        addPoint(lights, {10 * unit(random), 5 * unit(random), -15 + 16 * unit(random)}, 0.3);
    }
    const LightLists lists = assigned(usualGrid(), lights, 2);
    EXPECT_FALSE(lists.all_lights);
    const auto clusters = clustersByLight(lists, lights.lights.size());
    for (size_t i = 0; i < lights.lights.size(); i += 5003) {
        const auto needed = reference::clustersOf(usualGrid(), ballOf(lights, i));
        ASSERT_TRUE(
            std::includes(clusters[i].begin(), clusters[i].end(), needed.begin(), needed.end()));
    }
}

TEST(LightAssigner, CountsAroundWordWidths_DoNotWrap) {
    const ClusterGrid grid = makeClusterGrid({1, 1, 1}, {64, 64}, perspective(45), 0.5, 35);
    for (const uint32_t count : {255U, 256U, 257U, 511U, 512U, 65535U, 65536U, 65537U}) {
        light::FrameLights lights;
        for (uint32_t i = 0; i < count; ++i) {
            addPoint(lights, {0, 0, -10}, 1);
        }
        const LightLists lists = assigned(grid, lights, 2);
        ASSERT_EQ(lists.clusters[0].count, count);
        std::vector<uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(lists.indices, all);
    }
}

TEST(LightAssigner, DuplicateLights_AreAllListed) {
    light::FrameLights lights;
    for (int i = 0; i < 5000; ++i) {
        addPoint(lights, {0.3, 0.2, -10}, 0.01);
    }
    const LightLists lists = assigned(usualGrid(), lights, 2);
    EXPECT_EQ(lists.stats.largest, 5000U);
    const auto clusters = clustersByLight(lists, 5000);
    for (const auto& of_light : clusters) {
        ASSERT_EQ(of_light, clusters[0]);
    }
}

TEST(LightAssigner, ReusedBuffers_HoldNothingOfTheFrameBefore) {
    LightAssigner assigner(2);
    LightLists reused;
    const settings::Size sizes[] = {{1280, 720}, {17, 33}, {1919, 1079}, {640, 360}, {640, 360}};
    const size_t counts[] = {5000, 10, 0, 5000, 700};
    for (size_t i = 0; i < std::size(counts); ++i) {
        const uint32_t slices = i % 2 == 0 ? 24U : 7U;
        const ClusterGrid grid =
            makeClusterGrid({16, 9, slices}, sizes[i], perspective(45), 0.5, 35);
        const auto lights = scattered(counts[i], static_cast<unsigned>(i));
        assigner.assign(grid, lights, reused);
        expectSame(reused, assigned(grid, lights));
        EXPECT_EQ(reused.stats.light_count, counts[i]);
    }
}

TEST(LightAssigner, Stats_DescribeTheLists) {
    const LightLists lists = assigned(usualGrid(), scattered(500, 9));
    uint32_t empty = 0;
    uint32_t largest = 0;
    for (const auto& list : lists.clusters) {
        empty += list.count == 0 ? 1U : 0U;
        largest = std::max(largest, list.count);
    }
    EXPECT_EQ(lists.stats.light_count, 500U);
    EXPECT_EQ(lists.stats.cluster_count, 16U * 9U * 24U);
    EXPECT_EQ(lists.stats.empty_count, empty);
    EXPECT_EQ(lists.stats.largest, largest);
    std::vector<uint32_t> lengths;
    for (const auto& list : lists.clusters) {
        if (list.count > 0) {
            lengths.push_back(list.count);
        }
    }
    std::sort(lengths.begin(), lengths.end());
    const uint32_t p95 = lengths[(lengths.size() * 95 + 99) / 100 - 1];
    EXPECT_GE(lists.stats.p95, p95);
    EXPECT_LE(lists.stats.p95, p95 + p95 / 16);
    EXPECT_EQ(lists.stats.bytes, lists.clusters.size() * 8 + lists.indices.size() * 4);
    EXPECT_DOUBLE_EQ(lists.stats.mean, static_cast<double>(lists.indices.size()) /
                                           (lists.stats.cluster_count - empty));
}

TEST(LightAssigner, BeyondTheLimit_EveryClusterNamesAllLights) {
    const auto lights = scattered(2000, 4);
    const ClusterGrid grid = usualGrid();
    const uint64_t entries = assigned(grid, lights).stats.entry_count;
    for (const unsigned threads : {1U, 2U}) {
        LightAssigner fits(threads, entries);
        LightLists lists;
        fits.assign(grid, lights, lists);
        EXPECT_FALSE(lists.all_lights);

        LightAssigner full(threads, entries - 1);
        full.assign(grid, lights, lists);
        EXPECT_TRUE(lists.all_lights);
        EXPECT_TRUE(lists.stats.overflowed);
        ASSERT_EQ(lists.indices.size(), 2000U);
        for (uint32_t i = 0; i < 2000; ++i) {
            ASSERT_EQ(lists.indices[i], i);
        }
        for (const auto& list : lists.clusters) {
            ASSERT_EQ(list.offset, 0U);
            ASSERT_EQ(list.count, 2000U);
        }
        EXPECT_EQ(lists.stats.largest, 2000U);
        EXPECT_EQ(lists.stats.empty_count, 0U);

        full.assign(grid, scattered(10, 1), lists);
        EXPECT_FALSE(lists.all_lights);
    }
}

TEST(LightAssigner, InParts_TheSameLists) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        for (const size_t count : {0U, 257U, 3000U}) {
            const auto lights = scattered(count, 5);
            const LightLists whole = assigned(usualGrid(), lights);
            for (const uint64_t work : {uint64_t{1000}, uint64_t{100'000}, UINT64_MAX}) {
                SCOPED_TRACE(::testing::Message() << threads << " threads, " << count << " lights, "
                                                  << work << " at once");
                LightAssigner assigner(threads);
                const ClusterGrid grid = usualGrid();
                LightLists lists;
                LightAssignment parts(assigner, grid, lights, lists);
                uint64_t calls = 1;
                while (!parts.advance(work)) {
                    ++calls;
                }
                expectSame(lists, whole);
                const uint64_t all = count + whole.stats.entry_count +              // swept
                                     whole.stats.entry_count + grid.clusterCount(); // filled
                EXPECT_GE(calls, all / (2 * work));
                EXPECT_LE(calls, 2 + 2 * threads * all / work);
                EXPECT_TRUE(parts.advance(work));
            }
        }
    }
}

// 200 lights beside the picture, each in the depth of 30 slices and more of 128 rows: 800,000 lines
// to look at, and no entry.
TEST(LightAssigner, InParts_LinesThatLightsMissAreWork) {
    light::FrameLights lights;
    for (int i = 0; i < 200; ++i) {
        addPoint(lights, {1000, 0, -15}, 2);
    }
    const ClusterGrid grid = makeClusterGrid({{1, 128, 256}, settings::GridLaw::kLinear},
                                             {16, 1024}, orthographic(5), 0.5, 30);
    LightAssigner assigner(1);
    LightLists lists;
    LightAssignment parts(assigner, grid, lights, lists);
    int calls = 1;
    while (!parts.advance(10'000)) {
        ++calls;
    }
    EXPECT_EQ(lists.stats.entry_count, 0U);
    const int for_clusters = 1 + 128 * 256 / 10'000;
    EXPECT_GT(calls, for_clusters + 15);
}

TEST(LightAssigner, InPartsBeyondTheLimit_EveryClusterNamesAllLights) {
    const auto lights = scattered(2000, 4);
    const ClusterGrid grid = usualGrid();
    LightAssigner full(2, assigned(grid, lights).stats.entry_count - 1);
    LightLists whole;
    full.assign(grid, lights, whole);
    LightLists lists;
    LightAssignment parts(full, grid, lights, lists);
    while (!parts.advance(500)) {
    }
    expectSame(lists, whole);
    EXPECT_TRUE(lists.stats.overflowed);
}

// One is under way. Who comes meanwhile finishes it, whether or not its owner comes back, and
// what is assigned at once does not wait.
TEST(LightAssigner, SeveralInParts_HelpEachOther) {
    LightAssigner assigner(2);
    const ClusterGrid grid = usualGrid();
    const auto first_lights = scattered(3000, 5);
    const auto second_lights = scattered(2000, 6);
    LightLists first;
    LightLists second;
    LightLists between;
    LightAssignment owner(assigner, grid, first_lights, first);
    LightAssignment other(assigner, grid, second_lights, second);
    ASSERT_FALSE(owner.advance(1000));
    assigner.assign(grid, scattered(700, 7), between);
    while (!other.advance(1000)) {
    }
    EXPECT_TRUE(owner.advance(1000));
    expectSame(first, assigned(grid, first_lights));
    expectSame(second, assigned(grid, second_lights));
    expectSame(between, assigned(grid, scattered(700, 7)));
}

TEST(LightAssigner, InPartsGivenUp_LeavesNothing) {
    LightAssigner assigner(2);
    const ClusterGrid grid = usualGrid();
    const auto lights = scattered(2000, 6);
    LightLists lists;
    {
        const auto gone_lights = scattered(3000, 5);
        LightLists gone;
        LightAssignment gives_up(assigner, grid, gone_lights, gone);
        ASSERT_FALSE(gives_up.advance(1000));
    }
    LightAssignment parts(assigner, grid, lights, lists);
    while (!parts.advance(1000)) {
    }
    expectSame(lists, assigned(grid, lights));
}

} // namespace
} // namespace froxel::cluster::testing
