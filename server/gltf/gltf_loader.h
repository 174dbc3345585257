// Loads glTF 2.0 files, .gltf and .glb.
#pragma once

#include "core/error.h"
#include "core/progress.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <limits>

namespace froxel::gltf {

// How much memory reading may take: what a file says it needs is held against it before it is
// allocated, so that a file of a few bytes cannot have the process killed.
struct LoadLimits {
    uint64_t memory_bytes = std::numeric_limits<uint64_t>::max();
};

// The default scene of the file, validated; Scene::warnings says what was left out. Trusts nothing
// in the file, and reads no file outside the folder that it lies in. Tangents are only those in the
// file. Safe from any thread; decodes images on a second one. Errors: kScene, one line that names
// the file, the thing, its value and what would be right; kCancelled where `report` has it end.
[[nodiscard]] Result<scene::Scene> load(const std::filesystem::path& path,
                                        const ProgressReport& report = workOn,
                                        const LoadLimits& limits = {});

} // namespace froxel::gltf
