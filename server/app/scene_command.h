// `froxel scene`: a built-in scene as a glTF file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace froxel::app {

struct SceneOptions {
    std::filesystem::path out;       // .glb
    std::optional<uint32_t> spheres; // triangles of a field of them; none: the hall
    std::optional<uint32_t> copies;  // of each of its meshes; none: 1
};

// Throws StartupError.
void runScene(const SceneOptions& options);

} // namespace froxel::app
