#include "app/row_command.h"

#include "app/render_arguments.h"

#include <cstdint>
#include <string>

namespace froxel::app {

std::string rowCommand(const BenchOptions& options,
                       const bench::RunResult& result,
                       const bench::Row& row,
                       size_t frame_count) {
    const auto& view = result.base.views[row.timedView()];
    RenderOptions render;
    render.scene = options.scene;
    render.environment_file = options.environment_file;
    render.device.choice = options.device.choice;
    render.settings = row.settings;
    if (row.settings.material_variant > 0) {
        render.choices.material_variant = std::to_string(row.settings.material_variant);
    }
    render.light_set = row.light_set.empty() ? options.light_set : row.light_set;
    render.time_s = view.time_s;
    render.frame_count = static_cast<uint32_t>(frame_count);
    render.warmup_count = result.budget.warmup_first;
    render.keep_surfaces = row.keep_surfaces;
    render.timings = "timings.json";
    return shellCommand(renderArguments(render, view.name));
}

} // namespace froxel::app
