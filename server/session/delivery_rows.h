// The rows of DeliverySettings: see view/setting_rows.h.
#pragma once

#include "session/delivery.h"
#include "view/setting.h"

namespace froxel::session {

inline constexpr std::array kDeliveryRows = {
    view::row<&DeliverySettings::adaptive>(
        view::Switch{"adaptive"},
        "adaptive",
        {"Whether quality and resolution give way to a slow link"}),
    view::row<&DeliverySettings::target_fps>(
        view::Range<double>{"target_fps", 0, 240},
        "target_fps",
        {"Frames a second that a moving view keeps at the expense of its resolution; 0: none"}),
    view::row<&DeliverySettings::refine>(
        view::Names{"refine", view::kRefineNames},
        "refine",
        {"How far a resting picture is refined; lossless: by PNG, which viewers must decode"}),
};

} // namespace froxel::session
