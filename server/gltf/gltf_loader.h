// Loads glTF 2.0 files, .gltf and .glb.
#pragma once

#include "core/error.h"
#include "core/progress.h"
#include "gltf/file_opener.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <limits>

namespace froxel::gltf {

// What reading may take and do. What a file says it needs is held against its memory before it is
// allocated, so that a file of a few bytes cannot have the process killed.
struct LoadLimits {
    uint64_t memory_bytes = std::numeric_limits<uint64_t>::max();
    // The scene's file must be where its path, which is canonical, says: it was looked at before,
    // and may have become a link that leads elsewhere.
    bool no_link = false;
};

// The default scene of the file, validated; Scene::warnings says what was left out. Trusts nothing
// in the file, and reads no file outside the folder that it lies in. Tangents are only those in the
// file. Safe from any thread; decodes images on a second one. Errors: kScene, one line that names
// the file, the thing, its value and what would be right; kCancelled where `report` has it end.
[[nodiscard]] Result<scene::Scene> load(const std::filesystem::path& path,
                                        const ProgressReport& report = workOn,
                                        const LoadLimits& limits = {});

// Likewise of files that somebody else opens; `file` names the scene. Without Scene::files.
[[nodiscard]] Result<scene::Scene> loadFrom(FileOpener& opener,
                                            const std::filesystem::path& file,
                                            const ProgressReport& report,
                                            uint64_t memory_bytes);

} // namespace froxel::gltf
