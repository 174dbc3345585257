// Which files are scenes, by the ends of their names.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace froxel {

// A VRM is a GLB.
inline constexpr std::array<std::string_view, 7> kSceneEndings = {".glb", ".gltf", ".vrm", ".obj",
                                                                  ".ply", ".stl",  ".3mf"};
// The same for a message.
inline constexpr std::string_view kSceneEndingsText = ".glb, .gltf, .vrm, .obj, .ply, .stl or .3mf";

// ".glb" of "Model.GLB".
[[nodiscard]] inline std::string lowerCaseEnding(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return ending;
}

[[nodiscard]] inline bool isSceneFile(const std::filesystem::path& file) {
    return std::ranges::find(kSceneEndings, lowerCaseEnding(file)) != kSceneEndings.end();
}

} // namespace froxel
