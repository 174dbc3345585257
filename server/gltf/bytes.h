#pragma once

#include <cstddef>
#include <vector>

namespace froxel::gltf {

using Bytes = std::vector<std::byte>;

} // namespace froxel::gltf
