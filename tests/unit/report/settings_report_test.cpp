// Every setting is in reports: two runs that differ in one must not read the same.
#include "report/settings_report.h"
#include "settings/setting_rows.h"
#include "support/settings.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <vector>

namespace froxel::report {
namespace {

using settings::ViewSettings;
using Change = std::function<void(ViewSettings&)>;

settings::PlacedLights onePlaced() {
    settings::PlacedLight light;
    light.id = 1;
    return settings::PlacedLights({light});
}

// Every row's, and what is by hand.
std::vector<Change> everyChange() {
    std::vector<Change> changes = {
        [](auto& v) { v.camera.eye_world.x += 1; },
        [](auto& v) { v.size.width_px += 1; },
        [](auto& v) { v.size.height_px += 1; },
        [](auto& v) { v.grid.automatic = false; },
        [](auto& v) {
            v.grid.automatic = false;
            v.grid.size.x += 1;
        },
        [](auto& v) { v.debug.grid_camera = settings::Camera(); },
        [](auto& v) {
            v.lights.box = BoundsD3{{0, 0, 0}, {1, 1, 1}};
        },
        [](auto& v) { v.lights.placed = onePlaced(); },
        [](auto& v) { v.toon_fragment.points[1].y = 0.5F; },
        [](auto& v) { v.toon_compute.points[1].y = 0.5F; },
    };
    for (const auto& row : settings::kSettingRows) {
        changes.emplace_back(
            [&row](ViewSettings& v) { row.set(v, test::otherValue(row, row.get(v))); });
    }
    return changes;
}

TEST(SettingsReport, EverySetting_ReadsDifferentlyThanAllOthers) {
    std::vector<std::string> told = {settingsReport({}).dump()};
    for (const Change& change : everyChange()) {
        ViewSettings settings;
        change(settings);
        const std::string report = settingsReport(settings).dump();
        EXPECT_EQ(std::count(told.begin(), told.end(), report), 0)
            << "change " << told.size() << " is not told: " << report;
        told.push_back(report);
    }
}

} // namespace
} // namespace froxel::report
