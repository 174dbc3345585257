// The rows of DeliverySettings: see settings/setting_rows.h.
#pragma once

#include "session/delivery.h"
#include "settings/setting.h"

namespace froxel::session {

inline constexpr std::array kDeliveryRows = {
    settings::row<&DeliverySettings::adaptive>(
        settings::Switch{"adaptive"},
        "adaptive",
        {"Adapt to the link", "Lowers quality and resolution on a slow link"}),
    settings::row<&DeliverySettings::target_fps>(
        settings::Range<double>{"target_fps", 0, 240},
        "target_fps",
        {"Target frame rate",
         "Frame rate that a moving view keeps by a geometry error of up to 2 px, where the scene "
         "has coarser levels, and then by lowering its resolution; 0: none",
         "fps"}),
    settings::row<&DeliverySettings::refine>(
        settings::Names{"refine", settings::kRefineNames},
        "refine",
        {"Refinement", "Quality of a static picture; lossless: PNG, which viewers must decode"}),
};

} // namespace froxel::session
