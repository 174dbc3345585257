#include "bench/rows.h"

#include <spdlog/fmt/fmt.h>

namespace froxel::bench {

std::string nameOf(const Way& way) {
    const auto name = nameOf(settings::kRendererNames, way.renderer);
    return way.stage != settings::LightingStage::kCompute
               ? name
               : name + ", " + nameOf(settings::kLightingStageNames, way.stage);
}

std::string nameOf(const settings::Size& size) {
    return fmt::format("{}x{}", size.width_px, size.height_px);
}

std::string grouped(uint32_t number) {
    auto text = fmt::format("{}", number);
    for (auto at = static_cast<ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
        text.insert(static_cast<size_t>(at), 1, ',');
    }
    return text;
}

Row rowOf(const Base& base, const Way& way, const std::string& label, double value) {
    Row row{.label = label,
            .series = nameOf(way),
            .value = value,
            .settings = base.settings,
            .only_view = {},
            .scaled_to = {},
            .stream = {}};
    row.settings.camera = base.views.front().camera;
    row.settings.renderer = way.renderer;
    row.settings.lighting = way.stage;
    return row;
}

} // namespace froxel::bench
