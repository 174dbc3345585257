// Reading an extension's object, already type-checked by json_types.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace froxel::gltf {

// The extension's object, or nullptr where the thing has none.
[[nodiscard]] inline const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions,
                                                          const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

[[nodiscard]] inline int intOr(const tinygltf::Value& object, const char* key, int fallback) {
    return object.Has(key) ? object.Get(key).GetNumberAsInt() : fallback;
}

[[nodiscard]] inline double
numberOr(const tinygltf::Value& object, const char* key, double fallback) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

[[nodiscard]] inline std::string
textOr(const tinygltf::Value& object, const char* key, const char* fallback) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>()
                                                         : fallback;
}

} // namespace froxel::gltf
