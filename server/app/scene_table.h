// What each scene of a folder is: `froxel info --scenes`.
#pragma once

#include "bake/reader_process.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace froxel::app {

// A row each, in the order of the catalogue: path, bytes (of the file), triangles, draws,
// materials, textures, device_bytes (about), animations, variants, warnings; or path, bytes and
// problem, one line. Reads all of them, one after another.
[[nodiscard]] nlohmann::ordered_json scenesReport(const std::filesystem::path& folder,
                                                  bake::Sandbox sandbox);

// The same as a table for people.
[[nodiscard]] std::string sceneTable(const nlohmann::ordered_json& rows);

} // namespace froxel::app
