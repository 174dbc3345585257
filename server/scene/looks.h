// Named presets of lights, environment and renderer.
#pragma once

#include "settings/settings.h"

#include <span>
#include <string_view>

namespace froxel::scene {

struct Look {
    std::string_view name; // of options and the protocol
    std::string_view label;
    std::string_view help; // what it shows, without a full stop
    // Changes what a scene begins with, whose lights have a radius and a brightness that suit it.
    // `software`: the device draws with the host's cores, and goes without what is dear there.
    void (*apply)(settings::ViewSettings& settings, bool software);
};

[[nodiscard]] std::span<const Look> looks();
// Null: none has this name.
[[nodiscard]] const Look* findLook(std::string_view name);
// "evening, noon, ..."
[[nodiscard]] std::span<const std::string_view> lookNames();

} // namespace froxel::scene
