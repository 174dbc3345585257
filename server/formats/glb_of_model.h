// What other formats hold, as a binary glTF file in memory: the loader of glTF is the one way to a
// scene, with all of its checks.
#pragma once

#include "formats/model.h"

#include <cstddef>
#include <vector>

namespace froxel::formats {

// Both sides of every surface are drawn: these formats seldom say which is meant. Throws
// gltf::Failure where a GLB cannot hold it (4 GiB).
[[nodiscard]] std::vector<std::byte> glbOf(const Model& model);

} // namespace froxel::formats
