// PLY (Stanford, Greg Turk): meshes of scanners, ASCII and binary of either byte order.
#pragma once

#include "formats/model.h"

#include <cstddef>
#include <span>

namespace froxel::formats {

// Reads x y z, nx ny nz, red green blue alpha, u v or s t of vertices; vertex_indices and texcoord
// of faces, whose polygons are taken for convex; the image that "comment TextureFile" names. What
// has no normals is smooth. PLY has no unit and no axis: it is read in metres with y up. Throws
// gltf::Failure, whatever the bytes are.
[[nodiscard]] Model readPly(std::span<const std::byte> file);

} // namespace froxel::formats
