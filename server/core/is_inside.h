#pragma once

#include <algorithm>
#include <filesystem>

namespace froxel {

// Whether a path leads into a folder, or is the folder. By their names: both are canonical, or were
// walked to on one way.
[[nodiscard]] inline bool isInside(const std::filesystem::path& path,
                                   const std::filesystem::path& folder) {
    return std::ranges::mismatch(folder, path).in1 == folder.end();
}

} // namespace froxel
