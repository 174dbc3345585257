// Loads every format that is a scene: glTF 2.0, and OBJ, PLY, STL and 3MF by way of it.
#pragma once

#include "core/error.h"
#include "core/progress.h"
#include "gltf/file_opener.h"
#include "gltf/gltf_loader.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>

namespace froxel::formats {

// As gltf::load() and gltf::loadFrom() have it; the end of `file`'s name tells the format.
[[nodiscard]] Result<scene::Scene> load(const std::filesystem::path& file,
                                        const ProgressReport& report = workOn,
                                        const gltf::LoadLimits& limits = {});
[[nodiscard]] Result<scene::Scene> loadFrom(gltf::FileOpener& opener,
                                            const std::filesystem::path& file,
                                            const ProgressReport& report,
                                            uint64_t memory_bytes);

} // namespace froxel::formats
