// `froxel scene`: the built-in scene as a glTF file.
#pragma once

#include <filesystem>

namespace froxel::app {

struct SceneOptions {
    std::filesystem::path out; // .glb
};

// Throws StartupError.
void runScene(const SceneOptions& options);

} // namespace froxel::app
