#include "report/settings_report.h"

#include "settings/setting_rows.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

namespace froxel::report {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json toJson(const settings::Camera& camera) {
    Json json = {{"eye", toJson(camera.eye_world)},
                 {"target", toJson(camera.target_world())},
                 {"up", toJson(camera.world_from_view[1])},
                 {"lens_shift", {camera.lens_shift.x, camera.lens_shift.y}}};
    if (camera.projection == settings::Projection::kPerspective) {
        json["yfov_deg"] = glm::degrees(camera.yfov_rad);
    } else {
        json["half_height_m"] = camera.half_height_m;
    }
    return json;
}

// Where a report has a setting: "/lights/radius_m" of "lights.radius_m".
Json::json_pointer pointerTo(const settings::Setting& setting) {
    std::string path = "/" + std::string(setting.path);
    std::replace(path.begin(), path.end(), '.', '/');
    return Json::json_pointer(path);
}

Json toJson(const settings::Setting& setting, const settings::SettingValue& value) {
    const auto plain = [&setting](const auto& of_kind) -> Json {
        using Value = std::decay_t<decltype(of_kind)>;
        if constexpr (std::is_same_v<Value, settings::Choice>) {
            return setting.value_names[of_kind.index];
        } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
            return toJson(of_kind);
        } else {
            return of_kind;
        }
    };
    return std::visit(plain, value);
}

Json toJson(const settings::ToonRamp& ramp) {
    Json points = Json::array();
    for (uint32_t i = 0; i < ramp.count; ++i) {
        const auto& point = ramp.points[i];
        points.push_back({point.x, point.y, point.slope});
    }
    return points;
}

} // namespace

Json settingsReport(const settings::ViewSettings& settings) {
    Json json;
    for (const auto& row : settings::kSettingRows) {
        json[pointerTo(row)] = toJson(row, row.get(settings));
    }
    const settings::Lights& lights = settings.lights;
    json["lights"]["box_m"] =
        lights.box ? Json{{"min", toJson(lights.box->min)}, {"max", toJson(lights.box->max)}}
                   : Json(nullptr);
    json["lights"]["placed"] = lights.placed.lights().size();
    json["width_px"] = settings.size.width_px;
    json["height_px"] = settings.size.height_px;
    const settings::GridSize& grid = settings.grid.size;
    json["grid"] = settings.grid.automatic ? Json("auto") : Json{grid.x, grid.y, grid.z};
    json["camera"] = toJson(settings.camera);
    // Only what is not usual: few ever change them.
    if (settings.debug.grid_camera) {
        json["grid_camera"] = toJson(*settings.debug.grid_camera);
    }
    const settings::ViewSettings usual;
    if (settings.toon_fragment != usual.toon_fragment) {
        json["toon_fragment"] = toJson(settings.toon_fragment);
    }
    if (settings.toon_compute != usual.toon_compute) {
        json["toon_compute"] = toJson(settings.toon_compute);
    }
    return json;
}

} // namespace froxel::report
