// The path of --path.
#pragma once

#include "path/camera_path.h"
#include "scene/scene.h"

#include <string>

namespace froxel::app {

// One of path::kBuiltInNames, which takes `seconds` and begins with `first`, or a file of
// path/path_file.h. Errors: kIo; kInvalidArgument naming the file and what would be right.
[[nodiscard]] Result<path::CameraPath> readCameraPath(const std::string& name,
                                                      const scene::Scene& scene,
                                                      const settings::Camera& first,
                                                      double seconds);

} // namespace froxel::app
