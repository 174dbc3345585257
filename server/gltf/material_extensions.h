// The extensions of materials that are read and written: a row each, of which the reader, the
// writer, the checks of a file's JSON and docs/guide/scenes.md are made. What is no factor and no
// texture has a name here and code of its own in both.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>

namespace froxel::gltf {

inline constexpr const char* kUnlit = "KHR_materials_unlit";
inline constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
inline constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";

// What a factor may be; anything else is told and brought to what may be.
enum class FactorRange : uint8_t {
    kUnit,     // 0 to 1
    kFromZero, // 0 or more
    kIor,      // 0 or at least 1
    kFromOne,  // 1 or more
    kAny,
};

struct MaterialFactor {
    const char* key; // of the extension's object
    FactorRange range;
    std::span<float> (*of)(scene::Material&); // a number, or the three of a colour
    bool always = false;                      // written where it is as usual, too
};

struct MaterialTexture {
    const char* key;
    uint32_t slot;                               // of interface/material_slots.h
    float& (*scale)(scene::Material&) = nullptr; // of a normal map
};

struct MaterialExtension {
    const char* name;
    const char* what; // for readers
    std::span<const MaterialFactor> factors = {};
    std::span<const MaterialTexture> textures = {};
    // Means nothing beside kGlossiness, which has another dielectric part.
    bool of_dielectric = false;
    bool (*present)(const scene::Material&) = nullptr; // null: where a factor or a texture is
};

// Lives as long as the program.
[[nodiscard]] std::span<const MaterialExtension> materialExtensions();

} // namespace froxel::gltf
