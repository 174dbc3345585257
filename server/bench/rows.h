// How the presets make their rows. Pure.
#pragma once

#include "bench/sweep.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace froxel::bench {

// A renderer with the stage that adds lights up; a line of most plots.
struct Way {
    settings::Renderer renderer;
    settings::LightingStage stage;
};
inline constexpr Way kNaive{settings::Renderer::kNaive, settings::LightingStage::kFragment};
inline constexpr Way kForwardPlus{settings::Renderer::kForwardPlus,
                                  settings::LightingStage::kFragment};
inline constexpr Way kDeferred{settings::Renderer::kClusteredDeferred,
                               settings::LightingStage::kAuto};
// Where arithmetic is slow in the fragment stage these are the fair comparison of algorithms.
inline constexpr Way kNaiveCompute{settings::Renderer::kNaive, settings::LightingStage::kCompute};
inline constexpr Way kForwardPlusCompute{settings::Renderer::kForwardPlus,
                                         settings::LightingStage::kCompute};
inline constexpr std::array kWays = {kNaive, kNaiveCompute, kForwardPlus, kForwardPlusCompute,
                                     kDeferred};
inline constexpr std::array kListWays = {kForwardPlus, kForwardPlusCompute, kDeferred};

template <class Names, class Enum>
[[nodiscard]] std::string nameOf(const Names& names, Enum value) {
    return std::string(names[static_cast<size_t>(value)]);
}
// "naive", "naive, compute"; the deferred renderers' stage is their own
[[nodiscard]] std::string nameOf(const Way& way);
// "1280x720"
[[nodiscard]] std::string nameOf(const settings::Size& size);
// 12,345
[[nodiscard]] std::string grouped(uint32_t number);

// The base as `way` draws it from the first view.
[[nodiscard]] Row rowOf(const Base& base, const Way& way, const std::string& label, double value);

// The same with settings that `change` has changed.
template <class Change>
[[nodiscard]] Row rowOf(const Base& base,
                        const Way& way,
                        const std::string& label,
                        double value,
                        const Change& change) {
    auto row = rowOf(base, way, label, value);
    change(row.settings);
    return row;
}

} // namespace froxel::bench
