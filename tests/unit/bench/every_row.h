// All presets' rows, over a base of two views.
#pragma once

#include "bench/presets.h"

#include <vector>

namespace froxel::bench {

inline Base base() {
    Base base;
    base.settings.lights.box = BoundsD3{{-10, 0, -5}, {10.1, 8, 5}};
    base.settings.lights.intensity = 0.7F;
    base.settings.lights.seed = 9;
    for (const char* name : {"-7,2,0;0,2,0.3;45", "Nave of 'Hall'"}) {
        base.views.push_back({name, settings::lookAt({-7, 2, 0}, {0, 2, 0.3}, {0, 1, 0}),
                              static_cast<double>(base.views.size()) * 2.5});
    }
    base.views.front().camera.yfov_rad = glm::radians(45.0);
    return base;
}

inline std::vector<Sweep> everySweep() {
    std::vector<Sweep> sweeps;
    for (const auto name : presetNames()) {
        sweeps.push_back(makeSweep(name, base()));
    }
    return sweeps;
}

inline std::vector<Row> everyRow() {
    std::vector<Row> rows;
    for (const auto& sweep : everySweep()) {
        rows.insert(rows.end(), sweep.rows.begin(), sweep.rows.end());
    }
    return rows;
}

} // namespace froxel::bench
