#include "report/frame_report.h"

#include <nlohmann/json.hpp>

namespace froxel::report {

namespace {

using Json = nlohmann::ordered_json;

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

Json toJson(const GridStats& grid) {
    if (grid.x == 0) {
        return nullptr;
    }
    return {{"size", {grid.x, grid.y, grid.z}},
            {"tile_px", {grid.tile_width_px, grid.tile_height_px}},
            {"near_m", grid.near_m},
            {"far_m", grid.far_m},
            {"automatic", grid.automatic},
            {"why", grid.why}};
}

void add(Json& json, const Stat& stat) {
    const auto& [group, name, field, whole] = *stat.row;
    Json& object = group.empty() ? json : json[std::string(group)];
    object[std::string(name)] = whole ? Json(static_cast<uint64_t>(stat.value)) : Json(stat.value);
}

Json memoryOf(const FrameDetails& details) {
    Json memory = Json::object();
    for (const auto& use : details.memory) {
        memory[use.purpose] = use.bytes;
    }
    return memory;
}

} // namespace

Json frameReport(const FrameStats& stats) {
    const FrameDetails none;
    const FrameDetails& details = stats.details ? *stats.details : none;
    Json json = {{"kept", stats.surfaces_reused},
                 {"triangles", stats.triangle_count},
                 {"draws", stats.draw_count},
                 {"grid", toJson(stats.grid)},
                 {"light_lists", toJson(stats.lists)},
                 {"pairs", nullptr},
                 {"peel", nullptr},
                 {"plan", details.plan},
                 {"memory_bytes", memoryOf(details)}};
    for (const Stat& stat : stats.steps.all()) {
        add(json, stat);
    }
    return json;
}

} // namespace froxel::report
