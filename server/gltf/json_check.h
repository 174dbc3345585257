// The JSON of a scene file before tinygltf sees it, which recurses without bound and takes what it
// does not know.
#pragma once

#include "gltf/failure.h"
#include "gltf/limits.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace froxel::gltf {

[[nodiscard]] bool isSupportedExtension(std::string_view name);

// How many values the text has, as far as it is JSON. Throws Failure where it is longer than
// kMaxJsonBytes or has more values than `memory` is enough for, which it takes.
[[nodiscard]] size_t countValues(std::span<const std::byte> text, ReadMemory& memory);

// Throws Failure where the text is not a JSON object. It may nest
// to any depth; neither reading nor destroying it recurses.
[[nodiscard]] nlohmann::json parseJson(std::span<const std::byte> text);

// Afterwards types are as mendTypes() leaves them, nothing nests deeper than kMaxJsonDepth, the
// required properties are there, and `extras` and unknown extensions are gone, with a warning for
// each such extension. Throws Failure with the JSON pointer, the value and what would be right
// where it is no glTF 2.0 or there is no geometry without what is wrong; also where a required
// extension is not supported and stands at a buffer, a bufferView, an accessor or a primitive.
void checkJson(nlohmann::json& root, Warnings& warnings);

// By name, of what checkJson() has passed. At most kMaxChoices; none of a longer name than
// kMaxNameBytes.
[[nodiscard]] std::vector<scene::Extension> extensionsOf(const nlohmann::json& root);

} // namespace froxel::gltf
