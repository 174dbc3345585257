// Light from around that comes from a file: `--environment-file`.
#pragma once

#include "core/error.h"
#include "environment/reader.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>

namespace froxel::app {

// Errors name the file: kIo where it cannot be read, else those of environment::read().
[[nodiscard]] Result<environment::Panorama> readPanorama(const std::filesystem::path& file);

// The file's light; its warnings go to the log. Null for an empty path. Takes some seconds. Throws
// StartupError.
[[nodiscard]] std::shared_ptr<const environment::Surroundings>
readSurroundings(const std::filesystem::path& file);

// They become the scene's, where there are any.
void surround(scene::Scene& scene, std::shared_ptr<const environment::Surroundings> surroundings);

// Size, mean and brightest radiance, warnings.
[[nodiscard]] nlohmann::ordered_json environmentReport(const environment::Panorama& panorama);

} // namespace froxel::app
