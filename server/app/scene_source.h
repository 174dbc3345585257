// Where a scene comes from: the one entry point for `--scene PATH|builtin`.
#pragma once

#include "core/error.h"
#include "scene/scene.h"

#include <string>

namespace froxel::app {

// `builtin` gives the built-in hall, anything else is read as a glTF 2.0 or GLB file. Cameras that
// move stand where its usual clips have them at `time_s`. Errors: ErrorCode::kScene with one line.
[[nodiscard]] Result<scene::Scene> loadScene(const std::string& source, double time_s = 0);

// A line of the log for each of the scene's warnings, which are few.
void logWarnings(const scene::Scene& scene);

} // namespace froxel::app
