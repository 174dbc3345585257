// What was meant by a name that there is not.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace froxel::app {

// The one of `names` that the fewest changes of letters lead to; empty where that is not few, for
// which a third of the letters is the bound. Changes: a letter more, less or another, or two
// neighbours swapped (optimal string alignment).
[[nodiscard]] std::string nearestOf(std::string_view given, std::span<const std::string> names);

} // namespace froxel::app
