// The rows of DeliverySettings: see settings/setting_rows.h.
#pragma once

#include "session/delivery.h"
#include "settings/setting.h"

namespace froxel::session {

inline constexpr std::array kDeliveryRows = {
    settings::row<&DeliverySettings::adaptive>(
        settings::Switch{"adaptive"},
        "adaptive",
        {"Whether quality and resolution give way to a slow link"}),
    settings::row<&DeliverySettings::target_fps>(
        settings::Range<double>{"target_fps", 0, 240},
        "target_fps",
        {"Frames a second that a moving view keeps at the expense of its resolution; 0: none"}),
    settings::row<&DeliverySettings::refine>(
        settings::Names{"refine", settings::kRefineNames},
        "refine",
        {"How far a resting picture is refined; lossless: by PNG, which viewers must decode"}),
};

} // namespace froxel::session
