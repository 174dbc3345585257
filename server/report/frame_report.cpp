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
            {"kept", shadows.reused_count},
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

Json frameReport(const FrameStats& stats) {
    const FrameDetails none;
    const FrameDetails& details = stats.details ? *stats.details : none;
    Json json = {{"kept", stats.surfaces_reused},      {"triangles", stats.triangle_count},
                 {"draws", stats.draw_count},          {"grid", toJson(stats.grid)},
                 {"light_lists", toJson(stats.lists)}, {"pairs", toJson(stats.pairs)},
                 {"peel", toJson(stats.peel)},         {"plan", details.plan},
                 {"memory_bytes", memoryOf(details)}};
    if (stats.shadows.light_count > 0) {
        json["shadows"] = toJson(stats.shadows);
    }
    if (stats.metered_ev) {
        json["metered_ev"] = *stats.metered_ev;
    }
    return json;
}

} // namespace froxel::report
