// The part of findFault() that looks at what moves.
#pragma once

#include "scene/motion.h"

#include <optional>
#include <string>

namespace froxel::scene {

// The scene has motion, and its meshes and instances have no fault.
[[nodiscard]] std::optional<std::string> findMotionFault(const Scene& scene);

} // namespace froxel::scene
