// The named presets that Welcome offers, as settings in the form of the page's address.
#pragma once

#include "settings/settings.h"

#include <string>
#include <vector>

namespace froxel::session {

struct OfferedLook {
    std::string name; // of scene::looks()
    std::string label;
    std::string help;
    std::string address; // "lights=1000&bloom=none": each setting that any look sets
};

// All of them, over what a scene begins with. `software`: see scene::Look. Pure.
[[nodiscard]] std::vector<OfferedLook> offerLooks(const settings::ViewSettings& usual,
                                                  bool software);

} // namespace froxel::session
