// The words of the table of settings, for pages.
#pragma once

#include <string>

namespace froxel::session {

// JSON: a list of {"name", "label", "help", "unit", "cost"}, in the table's order, without units
// and costs that are empty. Made once; any thread.
[[nodiscard]] const std::string& settingWords();

} // namespace froxel::session
