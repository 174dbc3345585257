#include "app/timings_report.h"

#include "measure/statistics.h"
#include "view/setting_rows.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

namespace froxel::app {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json toJson(std::vector<double> samples) {
    const auto summary = measure::summarize(std::move(samples));
    return {{"min", summary.min},
            {"median", summary.median},
            {"p95", summary.p95},
            {"max", summary.max}};
}

Json toJson(const view::Camera& camera) {
    Json json = {{"eye", toJson(camera.eye_world)},
                 {"target", toJson(camera.target_world())},
                 {"up", toJson(camera.world_from_view[1])},
                 {"lens_shift", {camera.lens_shift.x, camera.lens_shift.y}}};
    if (camera.projection == view::Projection::kPerspective) {
        json["yfov_deg"] = glm::degrees(camera.yfov_rad);
    } else {
        json["half_height_m"] = camera.half_height_m;
    }
    return json;
}

template <class Sides>
Json sizeOf(const Sides& sides) {
    return {sides.x, sides.y, sides.z};
}

// Where a report has a setting: "/lights/radius_m" of "lights.radius_m".
Json::json_pointer pointerTo(const view::Setting& setting) {
    std::string path = "/" + std::string(setting.path);
    std::replace(path.begin(), path.end(), '.', '/');
    return Json::json_pointer(path);
}

Json toJson(const view::Setting& setting, const view::SettingValue& value) {
    const auto plain = [&setting](const auto& of_kind) -> Json {
        using Value = std::decay_t<decltype(of_kind)>;
        if constexpr (std::is_same_v<Value, view::Choice>) {
            return setting.names[of_kind.index];
        } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
            return toJson(of_kind);
        } else {
            return of_kind;
        }
    };
    return std::visit(plain, value);
}

Json toJson(const view::ToonRamp& ramp) {
    Json points = Json::array();
    for (uint32_t i = 0; i < ramp.count; ++i) {
        const auto& point = ramp.points[i];
        points.push_back({point.x, point.y, point.slope});
    }
    return points;
}

Json toJson(const LightListStats& lists) {
    return {{"lights", lists.light_count},
            {"clusters", lists.cluster_count},
            {"empty", lists.empty_count},
            {"entries", lists.entry_count},
            {"largest", lists.largest},
            {"overflowed", lists.overflowed},
            {"redraws", lists.redraw_count},
            {"mean", lists.mean},
            {"p95", lists.p95},
            {"bytes", lists.bytes},
            {"capped", lists.capped_count},
            {"dropped", lists.dropped_count},
            {"dropped_irradiance", lists.dropped_irradiance},
            {"all_lights", lists.all_lights},
            {"why", lists.why}};
}

Json frameTimes(const std::vector<FrameStats>& frames) {
    const auto collect = [&](double FrameStats::*time) {
        std::vector<double> samples;
        samples.reserve(frames.size());
        for (const auto& frame : frames) {
            samples.push_back(frame.*time);
        }
        return toJson(std::move(samples));
    };
    return {{"gpu_us", collect(&FrameStats::gpu_us)},
            {"host_us", collect(&FrameStats::host_us)},
            {"frame_us", collect(&FrameStats::frame_us)}};
}

Json passTimes(const std::vector<FrameStats>& frames) {
    std::vector<std::pair<std::string_view, std::vector<double>>> passes;
    for (const auto& frame : frames) {
        for (const auto& pass : frame.passes) {
            auto known = std::find_if(passes.begin(), passes.end(),
                                      [&](const auto& entry) { return entry.first == pass.name; });
            if (known == passes.end()) {
                known = passes.insert(known, {pass.name, {}});
            }
            known->second.push_back(pass.gpu_us);
        }
    }
    Json json = Json::array();
    for (auto& [name, samples] : passes) {
        const size_t count = samples.size();
        json.push_back({{"name", name}, {"frames", count}, {"gpu_us", toJson(std::move(samples))}});
    }
    return json;
}

Json toJson(const GridStats& grid) {
    if (grid.x == 0) {
        return nullptr;
    }
    return {{"size", sizeOf(grid)},        {"tile_px", {grid.tile_width_px, grid.tile_height_px}},
            {"near_m", grid.near_m},       {"far_m", grid.far_m},
            {"automatic", grid.automatic}, {"why", grid.why}};
}

Json toJson(const PairStats& pairs) {
    return pairs.counted
               ? Json{{"evaluated", pairs.evaluated}, {"contributing", pairs.contributing}}
               : Json(nullptr);
}

Json toJson(const PeelStats& peel) {
    return peel.layer_count > 0
               ? Json{{"layers", peel.layer_count}, {"overflow_pixels", peel.overflow_count}}
               : Json(nullptr);
}

Json toJson(const ShadowStats& shadows) {
    return {{"lights", shadows.light_count},
            {"maps", shadows.map_count},
            {"draws", shadows.draw_count},
            {"triangles", shadows.triangle_count}};
}

Json memoryOf(const FrameDetails& details) {
    Json memory = Json::object();
    for (const auto& use : details.memory) {
        memory[use.purpose] = use.bytes;
    }
    return memory;
}

} // namespace

Json settingsReport(const view::ViewSettings& settings) {
    Json json;
    for (const auto& row : view::kSettingRows) {
        json[pointerTo(row)] = toJson(row, row.get(settings));
    }
    const view::Lights& lights = settings.lights;
    json["lights"]["box_m"] =
        lights.box ? Json{{"min", toJson(lights.box->min)}, {"max", toJson(lights.box->max)}}
                   : Json(nullptr);
    json["lights"]["placed"] = lights.placed.lights().size();
    json["width_px"] = settings.size.width_px;
    json["height_px"] = settings.size.height_px;
    json["grid"] = settings.grid.automatic ? Json("auto") : sizeOf(settings.grid.size);
    json["camera"] = toJson(settings.camera);
    // Only what is not usual: few ever change them.
    if (settings.debug.grid_camera) {
        json["grid_camera"] = toJson(*settings.debug.grid_camera);
    }
    const view::ViewSettings usual;
    if (settings.toon_fragment != usual.toon_fragment) {
        json["toon_fragment"] = toJson(settings.toon_fragment);
    }
    if (settings.toon_compute != usual.toon_compute) {
        json["toon_compute"] = toJson(settings.toon_compute);
    }
    return json;
}

Json frameReport(const FrameStats& stats) {
    const FrameDetails none;
    const FrameDetails& details = stats.details ? *stats.details : none;
    Json json = {{"triangles", stats.triangle_count},
                 {"draws", stats.draw_count},
                 {"grid", toJson(stats.grid)},
                 {"light_lists", toJson(stats.lists)},
                 {"pairs", toJson(stats.pairs)},
                 {"peel", toJson(stats.peel)},
                 {"plan", details.plan},
                 {"memory_bytes", memoryOf(details)}};
    if (stats.shadows.light_count > 0) {
        json["shadows"] = toJson(stats.shadows);
    }
    return json;
}

Json timingsReport(const TimedRun& run) {
    return {{"schema", "froxel.timings.v1"},
            {"froxel", FROXEL_VERSION},
            {"device", toJson(run.device)},
            {"host", {{"threads", std::thread::hardware_concurrency()}}},
            {"scene", run.scene},
            {"settings", settingsReport(run.settings)},
            {"frames", run.frames.size()},
            {"warmup_frames", run.warmup_count},
            {"time_s", run.time_s},
            {"step_s", run.step_s},
            {"frame", frameTimes(run.frames)},
            {"passes", passTimes(run.frames)},
            {"last_frame", frameReport(run.frames.back())}};
}

} // namespace froxel::app
