// Where tests find what they read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace froxel::test {

// The absolute path of a file or folder of the repository, or beside it.
std::filesystem::path repositoryPath(std::string_view below);
// Of FROXEL_SPONZA, or where it is kept: Sponza's .gltf file, which may not be there.
std::filesystem::path sponzaPath();
// Of the binary of this build.
std::string binaryPath();

} // namespace froxel::test
