// The device's light lists against the host's, entry by entry, and against the oracle.
//
// FROXEL_TEST_DEVICE=gpu runs these on a GPU (support/gpu_fixture.h); FROXEL_TEST_CASES sets how
// many random configurations there are.
#include "cluster/assign_reference.h"
#include "support/device_assigner.h"
#include "support/gpu_fixture.h"
#include "support/tier.h"
#include "unit/cluster/assign_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace froxel::test {

namespace {

using cluster::ClusterGrid;
using cluster::testing::addPoint;
using cluster::testing::addSpot;
using cluster::testing::kUnlimited;
using cluster::testing::orthographic;
using cluster::testing::perspective;
using light::FrameLights;

class GpuAssignment : public SharedGpuTest {
  protected:
    static void SetUpTestSuite() {
        SharedGpuTest::SetUpTestSuite();
        assigner_ = std::make_unique<DeviceAssigner>(device());
        in_passes_ = std::make_unique<DeviceAssigner>(device(), kInPasses);
    }
    static void TearDownTestSuite() {
        in_passes_.reset();
        assigner_.reset();
        SharedGpuTest::TearDownTestSuite();
    }

    // As large grids are assigned.
    static constexpr render::ListLimits kInPasses{.line_entries = 0};

    inline static std::unique_ptr<DeviceAssigner> assigner_;
    inline static std::unique_ptr<DeviceAssigner> in_passes_;
};

cluster::LightLists onHost(const ClusterGrid& grid, const FrameLights& lights) {
    cluster::LightAssigner assigner(2);
    cluster::LightLists lists;
    assigner.assign(grid, lights, lists);
    return lists;
}

bool same(const io::ClusterList& a, const io::ClusterList& b) {
    return a.offset == b.offset && a.count == b.count;
}

void expectSame(const cluster::LightLists& device, const cluster::LightLists& host) {
    ASSERT_EQ(device.clusters.size(), host.clusters.size());
    for (size_t i = 0; i < host.clusters.size(); ++i) {
        ASSERT_TRUE(same(device.clusters[i], host.clusters[i]))
            << "cluster " << i << ": " << device.clusters[i].count << " lights at "
            << device.clusters[i].offset << ", the host has " << host.clusters[i].count << " at "
            << host.clusters[i].offset;
    }
    ASSERT_TRUE(device.indices == host.indices);
    EXPECT_EQ(device.stats.light_count, host.stats.light_count);
    EXPECT_EQ(device.stats.cluster_count, host.stats.cluster_count);
    EXPECT_EQ(device.stats.empty_count, host.stats.empty_count);
    EXPECT_EQ(device.stats.entry_count, host.stats.entry_count);
    EXPECT_EQ(device.stats.largest, host.stats.largest);
    EXPECT_EQ(device.stats.mean, host.stats.mean);
    EXPECT_EQ(device.stats.p95, host.stats.p95);
    EXPECT_EQ(device.stats.bytes, host.stats.bytes);
    EXPECT_EQ(device.stats.overflowed, host.stats.overflowed);
}

// Everything that makes assignment hard, in random proportions.
class RandomCase {
  public:
    explicit RandomCase(uint32_t seed) : random_(seed) {
        far_m_ = std::pow(10.0, pick(-1, 4));
        const double near_m = far_m_ * std::pow(10.0, pick(-6, 0));
        settings::Camera camera = flip(0.2) ? orthographic(far_m_ * pick(0.01, 1))
                                            : perspective(flip(0.2) ? pick(1, 170) : pick(30, 90));
        if (flip(0.3)) {
            camera.lens_shift = {pick(-1.5, 1.5), pick(-1.5, 1.5)};
        }
        const settings::GridSize size{whole(1, flip(0.1) ? 128 : 24),
                                      whole(1, flip(0.1) ? 128 : 16),
                                      whole(1, flip(0.1) ? 256 : 32)};
        const settings::Size image{whole(1, 2000), whole(1, 1200)};
        const auto law = static_cast<settings::GridLaw>(whole(0, 2));
        grid_ = cluster::makeClusterGrid({size, law}, image, camera, near_m, far_m_);
        const uint32_t count = flip(0.1) ? whole(0, 3) : whole(1, 150);
        for (uint32_t i = 0; i < count; ++i) {
            addLight();
        }
    }

    [[nodiscard]] const ClusterGrid& grid() const { return grid_; }
    [[nodiscard]] const FrameLights& lights() const { return lights_; }

  private:
    double pick(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    uint32_t whole(uint32_t low, uint32_t high) {
        return std::uniform_int_distribution<uint32_t>(low, high)(random_);
    }
    bool flip(double chance) { return pick(0, 1) < chance; }

    glm::dvec3 position() {
        const double depth = flip(0.05) ? 0 : far_m_ * (1.5 * std::pow(pick(0, 1), 2) - 0.25);
        const double scale = grid_.projection == settings::Projection::kPerspective
                                 ? std::abs(depth) + 0.1 * far_m_
                                 : 1;
        return {flip(0.05) ? 0 : (grid_.middle_x + pick(-1.5, 1.5) * grid_.half_x) * scale,
                flip(0.05) ? 0 : (grid_.middle_y + pick(-1.5, 1.5) * grid_.half_y) * scale, -depth};
    }

    // A radius that touches the eye, a plane or an edge to within a few roundings.
    double tangentRadius(const glm::dvec3& p) {
        const uint32_t z = whole(0, grid_.size.z);
        const double plane = static_cast<double>(grid_.plane_depths_m[z]);
        const double edge = grid_.columnEdge(whole(0, grid_.usedColumns()));
        const double choices[] = {glm::length(p), std::abs(plane + p.z),
                                  std::abs(p.x + edge * p.z) / std::sqrt(1 + edge * edge)};
        return choices[whole(0, 2)] * (1 + whole(0, 4) * 1e-7 - 2e-7);
    }

    void addLight() {
        const glm::dvec3 p = position();
        double radius = far_m_ * std::pow(10.0, pick(-4, 0.3));
        radius = flip(0.1) ? tangentRadius(p) : radius;
        radius = flip(0.02) ? static_cast<double>(kUnlimited) : radius;
        radius = flip(0.02) ? 0 : radius;
        if (flip(0.3)) {
            const glm::dvec3 way = flip(0.2) ? glm::dvec3(0, 0, -1)
                                             : glm::dvec3(pick(-1, 1), pick(-1, 1), pick(-1, 1));
            addSpot(lights_, p, radius, way, flip(0.2) ? pick(79, 81) : pick(0.01, 120));
        } else {
            addPoint(lights_, p, radius);
        }
    }

    std::mt19937 random_;
    double far_m_ = 1;
    ClusterGrid grid_;
    FrameLights lights_;
};

} // namespace

TEST_F(GpuAssignment, Arithmetic_OfThisDevice_RoundsAsTheHosts) {
    gpu::Timeline timeline(device());
    EXPECT_EQ(render::AssignPipelines::unusable(device(), timeline), "");
}

TEST_F(GpuAssignment, RandomAndAdversarialCases_GiveTheHostsLists) {
    const char* text = std::getenv("FROXEL_TEST_CASES");
    const uint32_t cases = text != nullptr ? static_cast<uint32_t>(std::atoi(text))
                           : wholeGrids()  ? 150
                                           : 60;
    uint32_t in_lines = 0;
    for (uint32_t seed = 0; seed < cases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomCase random(seed);
        const auto host = onHost(random.grid(), random.lights());
        expectSame(assigner_->assign(random.grid(), random.lights()), host);
        expectSame(in_passes_->assign(random.grid(), random.lights()), host);
        EXPECT_FALSE(in_passes_->inLines());
        in_lines += assigner_->inLines() ? 1U : 0U;
        if (HasFatalFailure()) {
            return;
        }
    }
    EXPECT_GT(in_lines, cases / 2);
}

TEST_F(GpuAssignment, RandomLights_MeetTheClustersOfTheOracle) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const auto law : {settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                           settings::GridLaw::kHyperbolic}) {
        const ClusterGrid grid =
            cluster::makeClusterGrid({{9, 7, 12}, law}, {640, 360}, perspective(70), 0.1, 40);
        FrameLights lights;
        for (int i = 0; i < 60; ++i) {
            addPoint(lights, glm::dvec3(unit(random), unit(random), unit(random) - 0.6) * 20.0,
                     std::pow(10.0, unit(random)));
        }
        const auto clusters = cluster::testing::clustersByLight(assigner_->assign(grid, lights),
                                                                lights.lights.size());
        for (size_t i = 0; i < clusters.size(); ++i) {
            const auto needed =
                cluster::reference::clustersOf(grid, cluster::testing::ballOf(lights, i));
            ASSERT_TRUE(std::includes(clusters[i].begin(), clusters[i].end(), needed.begin(),
                                      needed.end()));
        }
    }
}

TEST_F(GpuAssignment, NoLights_LeaveEmptyLists) {
    const ClusterGrid grid =
        cluster::makeClusterGrid({{4, 3, 2}}, {64, 64}, perspective(45), 0.1, 10);
    expectSame(assigner_->assign(grid, {}), onHost(grid, {}));
}

// One window of the bitmap, its borders, and several.
TEST_F(GpuAssignment, ListsOfAnyLength_AreInOrder) {
    const ClusterGrid grid =
        cluster::makeClusterGrid({{2, 2, 1}}, {64, 64}, perspective(45), 0.1, 10);
    for (const uint32_t count : {1U, 2U, 63U, 64U, 65U, 2047U, 2048U, 2049U, 4095U, 4096U, 4097U,
                                 5000U, 65535U, 65536U, 131072U, 131073U}) {
        SCOPED_TRACE(count);
        FrameLights lights;
        for (uint32_t i = 0; i < count; ++i) {
            addPoint(lights, {i % 3 == 0 ? 0.5 : -0.5, 0, -3}, 0.4);
        }
        const auto host = onHost(grid, lights);
        expectSame(assigner_->assign(grid, lights), host);
        EXPECT_EQ(assigner_->inLines(), count <= render::kLineLights);
        expectSame(in_passes_->assign(grid, lights), host);
    }
}

TEST_F(GpuAssignment, TooLittleRoom_GrowsToTheHostsLists) {
    const RandomCase random(3);
    const auto host = onHost(random.grid(), random.lights());
    ASSERT_GT(host.stats.entry_count, 200U);
    for (const auto& [entries, tasks] : {std::pair(1U, 100'000U), {100'000U, 1U}, {1U, 1U}}) {
        DeviceAssigner tight(device(),
                             {.first_entries = entries, .first_tasks = tasks, .line_entries = 0});
        expectSame(tight.assign(random.grid(), random.lights()), host);
        EXPECT_GT(tight.attempts(), 1U);
        expectSame(tight.assign(random.grid(), random.lights()), host);
        EXPECT_EQ(tight.attempts(), 1U);
    }
}

TEST_F(GpuAssignment, PastTheLimit_EveryClusterNamesAllLights) {
    const RandomCase random(3);
    const uint64_t entries = onHost(random.grid(), random.lights()).stats.entry_count;
    for (const uint64_t limit : {entries, entries - 1}) {
        cluster::LightAssigner host(1, limit);
        cluster::LightLists lists;
        host.assign(random.grid(), random.lights(), lists);
        EXPECT_EQ(lists.stats.overflowed, limit < entries);
        DeviceAssigner device(SharedGpuTest::device(), {.max_entries = limit});
        expectSame(device.assign(random.grid(), random.lights()), lists);
    }
}

TEST_F(GpuAssignment, MoreTasksThanMayBe_AreRefused) {
    const RandomCase random(3);
    DeviceAssigner device(SharedGpuTest::device(),
                          {.first_tasks = 1, .line_entries = 0, .max_tasks = 2});
    (void)device.assign(random.grid(), random.lights());
    EXPECT_TRUE(device.refused());
}

// More blocks than the scan's workgroup has invocations need the largest grid, which only a GPU is
// quick at.
TEST_F(GpuAssignment, LargestGrids_GiveTheHostsLists) {
    for (const settings::GridSize size :
         {settings::GridSize{128, 128, onGpu() ? 256U : 6U}, settings::GridSize{3, 3, 256}}) {
        const ClusterGrid grid =
            cluster::makeClusterGrid({size}, {1920, 1080}, perspective(60), 0.1, 50);
        FrameLights lights;
        addPoint(lights, {0, 0, -10}, 3);
        addPoint(lights, {1, 0, -20}, 4);
        addPoint(lights, {0, 0, 0}, static_cast<double>(kUnlimited));
        addPoint(lights, {-3, 1, -5}, 2);
        expectSame(assigner_->assign(grid, lights), onHost(grid, lights));
    }
}

TEST_F(GpuAssignment, MillionSmallLights_GiveTheHostsLists) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    FrameLights lights;
    lights.lights.reserve(1'000'000);
    for (int i = 0; i < 1'000'000; ++i) {
        addPoint(lights, {20 * unit(random) - 10, 8 * unit(random) - 4, -20 * unit(random)}, 0.05);
    }
    const ClusterGrid grid =
        cluster::makeClusterGrid({{16, 9, 24}}, {1920, 1080}, perspective(45), 1, 20);
    expectSame(assigner_->assign(grid, lights), onHost(grid, lights));
}

} // namespace froxel::test
