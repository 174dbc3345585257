// Paths that files name others by.
#pragma once

#include <algorithm>
#include <string>

namespace froxel::formats {

// With slashes: "C:\textures\wall 2.png" and "textures\wall 2.png". An absolute path is of another
// machine: its name alone is looked for.
[[nodiscard]] inline std::string sidePath(std::string name) {
    std::ranges::replace(name, '\\', '/');
    const bool absolute = name.starts_with('/') || (name.size() > 1 && name[1] == ':');
    return absolute ? name.substr(name.rfind('/') + 1) : name;
}

} // namespace froxel::formats
