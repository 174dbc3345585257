#include "app/timings_report.h"

#include "measure/statistics.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <thread>
#include <utility>

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

Json toJson(const view::Lights& lights) {
    return {{"count", lights.count},
            {"radius_m", lights.radius_m},
            {"intensity", lights.intensity},
            {"cutoff", lights.cutoff},
            {"cutoff_compensated", lights.cutoff_compensated},
            {"seed", lights.seed},
            {"animate", lights.animate},
            {"speed", lights.speed},
            {"box_m", lights.box
                          ? Json{{"min", toJson(lights.box->min)}, {"max", toJson(lights.box->max)}}
                          : Json(nullptr)},
            {"ambient", lights.ambient},
            {"scene_lights", lights.scene_lights},
            {"placed", lights.placed.lights().size()}};
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
    const auto nameOf = [](const auto& names, auto value) {
        return std::string(names[static_cast<size_t>(value)]);
    };
    Json json = {{"renderer", nameOf(view::kRendererNames, settings.renderer)},
                 {"lighting", nameOf(view::kLightingStageNames, settings.lighting)},
                 {"shading", nameOf(view::kShadingModelNames, settings.shading)},
                 {"gbuffer",
                  {{"normal", nameOf(view::kNormalEncodingNames, settings.gbuffer.normal)},
                   {"position", nameOf(view::kPositionSourceNames, settings.gbuffer.position)}}},
                 {"width_px", settings.size.width_px},
                 {"height_px", settings.size.height_px},
                 {"grid", settings.grid.automatic ? Json("auto") : sizeOf(settings.grid.size)},
                 {"grid_law", nameOf(view::kGridLawNames, settings.grid.law)},
                 {"light_loop", nameOf(view::kLightLoopNames, settings.light_loop)},
                 {"count_pairs", settings.count_pairs},
                 {"debug_view", view::nameOf(settings.debug.view)},
                 {"camera", toJson(settings.camera)},
                 {"lights", toJson(settings.lights)},
                 {"exposure", settings.exposure},
                 {"tone_map", nameOf(view::kToneMapNames, settings.tone_map)}};
    // Only what is on, so that runs without it compare with those of before it was there.
    if (const auto& bloom = settings.bloom; bloom.kind != view::BloomKind::kNone) {
        json["bloom"] = {{"kind", nameOf(view::kBloomKindNames, bloom.kind)},
                         {"threshold", bloom.threshold},
                         {"knee", bloom.knee},
                         {"strength", bloom.strength},
                         {"radius", bloom.radius}};
    }
    if (const auto& fog = settings.fog; fog.present()) {
        json["fog"] = {{"density", fog.density},
                       {"height_falloff", fog.height_falloff},
                       {"base_height_m", fog.base_height_m},
                       {"anisotropy", fog.anisotropy},
                       {"albedo", toJson(glm::dvec3(fog.albedo))},
                       {"tile_px", fog.tile_px},
                       {"slices", fog.slice_count},
                       {"half_rate", fog.half_rate},
                       {"noise", fog.noise}};
    }
    if (settings.antialiasing != view::Antialiasing::kNone) {
        json["antialiasing"] = nameOf(view::kAntialiasingNames, settings.antialiasing);
    }
    if (settings.transparency != view::Transparency::kSorted) {
        json["transparency"] = nameOf(view::kTransparencyNames, settings.transparency);
    }
    if (settings.transparency == view::Transparency::kPeeled) {
        json["peel_layers"] = settings.peel_layers;
    }
    if (const auto& shadows = settings.shadows; shadows.light_count > 0) {
        json["shadows"] = {{"lights", shadows.light_count}, {"size_px", shadows.size_px}};
    }
    if (const auto& outline = settings.toon_outline; outline.strength > 0) {
        json["toon_outline"] = {{"strength", outline.strength}, {"width", outline.width}};
    }
    if (settings.list_cap > 0) {
        json["list_cap"] = settings.list_cap;
    }
    if (settings.debug.scale_max > 0) {
        json["debug_scale_max"] = settings.debug.scale_max;
    }
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
