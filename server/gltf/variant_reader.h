// KHR_materials_variants: which materials a primitive has in the scene's variants.
#pragma once

#include "gltf/warnings.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <map>
#include <string>

namespace froxel::gltf {

// The file's material by variant; `pointer` and `user` name the primitive. What is broken is left
// out, with a warning.
[[nodiscard]] std::map<uint32_t, int> variantMaterials(const tinygltf::Primitive& source,
                                                       size_t variant_count,
                                                       const std::string& pointer,
                                                       const std::string& user,
                                                       Warnings& warnings);

} // namespace froxel::gltf
