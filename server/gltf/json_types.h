// The types of what glTF and the supported extensions have. tinygltf ignores a property of the
// wrong type and narrows 64-bit integers to 32, so every property that this loader uses has a rule
// here.
#pragma once

#include "gltf/failure.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::gltf {

// Afterwards every property of the table in json_types.cpp has the type and the length that it
// should, integers are in 0..2^31-1 (lengths and offsets in bytes in 0..2^32-1), and reals are in
// single precision's range. What is not is left out with a warning; of words that are no strings
// their readers tell. Throws Failure, with the JSON pointer, the value and what would be right,
// where geometry depends on it. `root` must not nest deeper than the stack is.
void mendTypes(nlohmann::json& root, Warnings& warnings);

} // namespace froxel::gltf
