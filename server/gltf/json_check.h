// The JSON of a scene file before tinygltf sees it. tinygltf ignores a property of the wrong type,
// narrows 64-bit integers to 32 and recurses without bound, so types, integer ranges and depth are
// checked here, for every property that this loader uses.
#pragma once

#include "gltf/failure.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace froxel::gltf {

[[nodiscard]] bool isSupportedExtension(std::string_view name);

// Throws Failure where the text is not a JSON object or is longer than kMaxJsonBytes. It may nest
// to any depth; neither reading nor destroying it recurses.
[[nodiscard]] nlohmann::json parseJson(std::span<const std::byte> text);

// Afterwards every property of the table in json_check.cpp has the type that it should, integers
// are in 0..2^31-1 (lengths and offsets in bytes in 0..2^32-1), nothing nests deeper than
// kMaxJsonDepth, the required ones are there, and `extras` and unknown extensions are gone, with a
// warning for each such extension. Throws Failure with the property's JSON pointer, its value and
// what would be right; also where a required extension is not supported and stands where geometry
// is: at a buffer, a bufferView, an accessor or a primitive.
void checkJson(nlohmann::json& root, Warnings& warnings);

} // namespace froxel::gltf
