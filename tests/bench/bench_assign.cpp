// Host time of a frame's lights: evaluation, depth range and assignment, for Sponza's view of
// lights with a radius of 2 m moving in a box of 20 x 8 x 10 m.
//
//   cmake --build build/test --target bench_assign && build/test/tests/bench/bench_assign
#include "cluster/cluster_grid.h"
#include "cluster/depth_range.h"
#include "cluster/grid_choice.h"
#include "cluster/light_assigner.h"
#include "light/light_rig.h"

#include <benchmark/benchmark.h>

namespace froxel {
namespace {

struct Setup {
    scene::Scene scene;
    settings::ViewSettings settings;

    Setup(uint32_t count, float radius_m) {
        scene.bounds_world = {{-15, -1, -9}, {14, 12, 9}};
        settings.camera = settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0});
        settings.lights.count = count;
        settings.lights.radius_m = radius_m;
        settings.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    }
};

void evaluate(benchmark::State& state) {
    const Setup setup(static_cast<uint32_t>(state.range(0)), 2);
    const light::LightRig rig(setup.scene);
    light::FrameLights lights;
    double time_s = 0;
    for (auto _ : state) {
        rig.evaluate(setup.settings.lights, setup.settings.camera, time_s, lights);
        time_s += 1.0 / 60;
        benchmark::DoNotOptimize(lights.lights.data());
    }
}
BENCHMARK(evaluate)->Arg(1'000)->Arg(5'000)->Arg(100'000)->Arg(1'000'000)->Unit(
    benchmark::kMillisecond);

// The automatic grid of a frame.
void choose(benchmark::State& state) {
    const Setup setup(static_cast<uint32_t>(state.range(0)), 2);
    const light::LightRig rig(setup.scene);
    light::FrameLights lights;
    rig.evaluate(setup.settings.lights, setup.settings.camera, 0, lights);
    const auto range =
        cluster::litDepthRange(lights, setup.settings.camera, setup.scene.bounds_world);
    const auto frustum = cluster::makeClusterGrid({.size = {1, 1, 1}}, setup.settings.size,
                                                  setup.settings.camera, range.near_m, range.far_m);
    for (auto _ : state) {
        const auto spread = cluster::lightSpread(frustum, lights);
        const auto choice = cluster::chooseGrid(
            {frustum, range, settings::GridLaw::kLogarithmic, spread, cluster::kCpuCosts}, {});
        benchmark::DoNotOptimize(choice.list_length);
        state.SetLabel(choice.why);
    }
}
BENCHMARK(choose)->Arg(1'000)->Arg(5'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

// Arguments: lights, radius in cm, threads, grid x, y, z.
void assign(benchmark::State& state) {
    const Setup setup(static_cast<uint32_t>(state.range(0)),
                      static_cast<float>(state.range(1)) / 100);
    const light::LightRig rig(setup.scene);
    light::FrameLights lights;
    rig.evaluate(setup.settings.lights, setup.settings.camera, 0, lights);
    cluster::LightAssigner assigner(static_cast<unsigned>(state.range(2)));
    cluster::LightLists lists;
    const settings::GridSize size{static_cast<uint32_t>(state.range(3)),
                                  static_cast<uint32_t>(state.range(4)),
                                  static_cast<uint32_t>(state.range(5))};
    for (auto _ : state) {
        const auto range =
            cluster::litDepthRange(lights, setup.settings.camera, setup.scene.bounds_world);
        const auto grid = cluster::makeClusterGrid(
            {size}, setup.settings.size, setup.settings.camera, range.near_m, range.far_m);
        assigner.assign(grid, lights, lists);
        benchmark::DoNotOptimize(lists.indices.data());
    }
    state.counters["entries"] = static_cast<double>(lists.stats.entry_count);
    state.counters["mean"] = lists.stats.mean;
    state.counters["largest"] = lists.stats.largest;
}
BENCHMARK(assign)
    ->ArgNames({"lights", "r_cm", "threads", "x", "y", "z"})
    ->Args({1'000, 200, 1, 16, 9, 24})
    ->Args({5'000, 200, 1, 16, 9, 24})
    ->Args({5'000, 200, 2, 16, 9, 24})
    ->Args({5'000, 200, 1, 32, 18, 32})
    ->Args({5'000, 200, 1, 32, 16, 64})
    ->Args({100'000, 20, 1, 16, 9, 24})
    ->Args({100'000, 20, 2, 16, 9, 24})
    ->Args({100'000, 200, 2, 16, 9, 24})
    ->Args({1'000'000, 30, 1, 16, 9, 24})
    ->Args({1'000'000, 30, 2, 40, 23, 32})
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace froxel

BENCHMARK_MAIN();
