// The words of the table of settings, for pages.
#pragma once

#include <string>

namespace froxel::session {

// JSON: a list of {"name", "label", "help", "unit", "cost", "compare"}, in the table's order,
// without units and costs that are empty; "compare" is true where the sides of a comparison may
// differ, else absent. Made once; any thread.
[[nodiscard]] const std::string& settingWords();

} // namespace froxel::session
