// STL, of either kind: triangles and nothing else.
#pragma once

#include "formats/model.h"

#include <cstddef>
#include <span>

namespace froxel::formats {

// STL has no unit and no axis: it is read in millimetres with z up, as 3D printing has them.
// Normals and colours of the file are not read: each triangle is flat. Throws gltf::Failure,
// whatever the bytes are.
[[nodiscard]] Model readStl(std::span<const std::byte> file);

} // namespace froxel::formats
