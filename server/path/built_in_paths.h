// Paths that every scene has. Pure; any thread.
#pragma once

#include "path/camera_path.h"
#include "scene/scene.h"

#include <array>
#include <string_view>

namespace froxel::path {

enum class BuiltIn : uint8_t { kTurntable, kFlythrough };
inline constexpr std::array kBuiltInNames = {std::string_view("turntable"),
                                             std::string_view("flythrough")};

// turntable: once round what `first` looks at, at its height and distance, at a constant speed.
// flythrough: through the scene's cameras in their order, or, with fewer than two, from `first`
// along the way that it looks, to the other side of the scene. `seconds` is more than 0.
[[nodiscard]] PathKeys
builtInPath(BuiltIn path, const scene::Scene& scene, const settings::Camera& first, double seconds);

} // namespace froxel::path
