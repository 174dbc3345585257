// 3MF, by the 3MF Consortium's lib3mf: a zip of XML, as 3D printing has it.
#pragma once

#include "formats/model.h"

#include <cstddef>
#include <span>

namespace froxel::formats {

// Reads build items and components with their transforms, meshes, colours of base materials and
// colour groups, and the unit; z is up. Textures, beams, slices and volumes are not drawn. Throws
// gltf::Failure, whatever the bytes are.
[[nodiscard]] Model readThreeMf(std::span<const std::byte> file, gltf::Warnings& warnings);

} // namespace froxel::formats
