// The path of --path.
#pragma once

#include "path/camera_path.h"
#include "scene/scene.h"

#include <string>

namespace froxel::app {

// A file of path/path_file.h. Errors: kIo; kInvalidArgument naming the file and what would be
// right.
[[nodiscard]] Result<path::CameraPath> readPathFile(const std::string& file);

// One of path::kBuiltInNames, which takes `seconds` and begins with `first`, or a file.
// Errors: of readPathFile().
[[nodiscard]] Result<path::CameraPath> readCameraPath(const std::string& name,
                                                      const scene::Scene& scene,
                                                      const settings::Camera& first,
                                                      double seconds);

} // namespace froxel::app
