// Figures that others published for the same experiments, with their hardware.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace froxel::bench {

// The field `published` of a result (tests/bench/results/README.md).
[[nodiscard]] nlohmann::ordered_json publishedFigures();

} // namespace froxel::bench
