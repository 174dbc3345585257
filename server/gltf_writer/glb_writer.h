// Writes a scene as one binary glTF 2.0 file.
#pragma once

#include "core/error.h"
#include "scene/scene.h"

#include <filesystem>

namespace froxel::gltf_writer {

// Images are embedded as PNG; the same scene gives the same bytes with the same libpng and zlib.
// Cameras lose their focus distance, orthographic ones get a far plane behind the scene: glTF has
// no place for the one and demands the other. Safe from any thread.
// Errors: kScene for what glTF cannot hold (a sheared instance, a number that is not finite, more
// than 4 GiB), kIo when the file cannot be written; an unfinished file is removed.
[[nodiscard]] Result<void> writeGlb(const scene::Scene& scene, const std::filesystem::path& path);

} // namespace froxel::gltf_writer
