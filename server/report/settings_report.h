// Settings as reports tell them.
#pragma once

#include "view/settings.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::report {

// Every setting, under the path of its row (view/setting_rows.h): units are in the names.
[[nodiscard]] nlohmann::ordered_json settingsReport(const view::ViewSettings& settings);

} // namespace froxel::report
