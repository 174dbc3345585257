// Settings as reports tell them.
#pragma once

#include "settings/settings.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::report {

// Every setting, under the path of its row (settings/setting_rows.h): units are in the names.
[[nodiscard]] nlohmann::ordered_json settingsReport(const settings::ViewSettings& settings);

} // namespace froxel::report
