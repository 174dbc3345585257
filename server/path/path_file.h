// Camera paths as JSON files. The files may come from anywhere. Pure; any thread.
//
//   {"seconds": 12, "constant_speed": false, "loop": false,
//    "keys": [{"at_s": 0, "eye": [0, 1.6, 5], "target": [0, 1, 0], "up": [0, 1, 0], "fov_deg":
//    45}]}
//
// seconds (default: the last key's time), constant_speed, loop, at_s (default: evenly spaced, where
// no key has one), up (default: [0, 1, 0]) and fov_deg (default: 45) may be absent. Metres, world.
#pragma once

#include "path/camera_path.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace froxel::path {

inline constexpr size_t kMaxFileBytes = size_t{1} << 20U;

// Errors: kInvalidArgument, naming the field, its value and what would be right.
[[nodiscard]] Result<PathKeys> parsePath(std::string_view json);
// What parsePath() reads as the same path.
[[nodiscard]] std::string pathText(const PathKeys& path);

} // namespace froxel::path
