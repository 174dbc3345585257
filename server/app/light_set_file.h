// Files of placed lights, as the page saves them and --light-set reads them.
#pragma once

#include "core/error.h"
#include "settings/placed_lights.h"

#include <filesystem>

namespace froxel::app {

// The canonical JSON of a PlacedLights message that has `lights` alone. Errors: kIo;
// kInvalidArgument naming the file, the field, its value and what would be right.
[[nodiscard]] Result<settings::PlacedLights> readLightSet(const std::filesystem::path& path);

} // namespace froxel::app
