// Light from around that comes from a file: `--environment-file`.
#pragma once

#include "core/error.h"
#include "environment/reader.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace froxel::app {

// Errors name the file: kIo where it cannot be read, else those of environment::read().
[[nodiscard]] Result<environment::Panorama> readPanorama(const std::filesystem::path& file);

// The file's light becomes the scene's; its warnings go to the log. An empty path: none does. Takes
// some seconds. Throws StartupError.
void surround(scene::Scene& scene, const std::filesystem::path& file);

// Size, mean and brightest radiance, warnings.
[[nodiscard]] nlohmann::ordered_json environmentReport(const environment::Panorama& panorama);

} // namespace froxel::app
