// How the presets make their rows. Pure.
#pragma once

#include "app/bench_sweep.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace froxel::app {

// A renderer with the stage that adds lights up; a line of most plots.
struct BenchWay {
    view::Renderer renderer;
    view::LightingStage stage;
};
inline constexpr BenchWay kNaive{view::Renderer::kNaive, view::LightingStage::kFragment};
inline constexpr BenchWay kForwardPlus{view::Renderer::kForwardPlus,
                                       view::LightingStage::kFragment};
inline constexpr BenchWay kDeferred{view::Renderer::kClusteredDeferred, view::LightingStage::kAuto};
// Where arithmetic is slow in the fragment stage these are the fair comparison of algorithms.
inline constexpr BenchWay kNaiveCompute{view::Renderer::kNaive, view::LightingStage::kCompute};
inline constexpr BenchWay kForwardPlusCompute{view::Renderer::kForwardPlus,
                                              view::LightingStage::kCompute};
inline constexpr std::array kWays = {kNaive, kNaiveCompute, kForwardPlus, kForwardPlusCompute,
                                     kDeferred};
inline constexpr std::array kListWays = {kForwardPlus, kForwardPlusCompute, kDeferred};

template <class Names, class Enum>
[[nodiscard]] std::string nameOf(const Names& names, Enum value) {
    return std::string(names[static_cast<size_t>(value)]);
}
// "naive", "naive, compute"; the deferred renderers' stage is their own
[[nodiscard]] std::string nameOf(const BenchWay& way);
// "1280x720"
[[nodiscard]] std::string nameOf(const view::Size& size);
// 12,345
[[nodiscard]] std::string grouped(uint32_t number);

// The base as `way` draws it from the first view.
[[nodiscard]] BenchRow
rowOf(const BenchBase& base, const BenchWay& way, const std::string& label, double value);

// The same with settings that `change` has changed.
template <class Change>
[[nodiscard]] BenchRow rowOf(const BenchBase& base,
                             const BenchWay& way,
                             const std::string& label,
                             double value,
                             const Change& change) {
    auto row = rowOf(base, way, label, value);
    change(row.settings);
    return row;
}

} // namespace froxel::app
