// The last look at a scene before a device sees it: the loader lets none of this through, code that
// makes scenes may.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace froxel::scene {

// One line on the first thing that no frame could be drawn from: a number that is not finite or an
// index that leads nowhere. None where all is well. Lights are not looked at: light::LightRig
// leaves out what it cannot use.
[[nodiscard]] std::optional<std::string> findFault(const Scene& scene);

} // namespace froxel::scene
