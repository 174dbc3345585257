// Wavefront OBJ with its MTL files.
#pragma once

#include "formats/model.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace froxel::formats {

// A file beside this one; none: there is no such file, and a warning says so.
using OpenBeside = std::function<std::optional<std::vector<std::byte>>(const std::string& path)>;

// Reads o and g as meshes; v with colours, vt, vn, f; s where there are no normals; Kd, Ke, d, Ns,
// illum, Pr, Pm and the images map_Kd, map_d, map_Ke, map_Pr, map_Pm and norm with -o, -s and
// -clamp. Colours are sRGB, as most viewers take them. Lines, points, curves and bump maps are not
// drawn. OBJ has no unit and no axis: it is read in metres with y up. Throws gltf::Failure,
// whatever the bytes are, and what `open` throws.
[[nodiscard]] Model
readObj(std::span<const std::byte> file, const OpenBeside& open, gltf::Warnings& warnings);

} // namespace froxel::formats
