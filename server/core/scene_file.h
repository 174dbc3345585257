// Which files are scenes, by their names.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace froxel {

[[nodiscard]] inline bool isSceneFile(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return ending == ".gltf" || ending == ".glb" || ending == ".vrm"; // VRM is a GLB
}

} // namespace froxel
