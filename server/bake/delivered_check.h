// What a scene from another process must be before anything uses it.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace froxel::bake {

// The first fault of it, in one line: of scene::findFault(), and of what readers of files see to
// themselves (images, cameras, lights, bounds, names). Pure; visits all vertices.
[[nodiscard]] std::optional<std::string> findDeliveredFault(const scene::Scene& scene);

} // namespace froxel::bake
