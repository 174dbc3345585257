// What a material has, in one word: io::kMaterial* below, above a bit for each of its textures.
#pragma once

#include "interface/constants.h"
#include "interface/material_slots.h"

#include <bit>
#include <cstdint>

namespace froxel::render {

using MaterialFlags = uint64_t;

// `slot`: of interface/material_slots.h.
[[nodiscard]] constexpr MaterialFlags textureFlag(uint32_t slot) {
    return MaterialFlags{1} << (32U + slot);
}
// As shaders have them.
[[nodiscard]] constexpr uint32_t featuresOf(MaterialFlags flags) {
    return static_cast<uint32_t>(flags);
}
[[nodiscard]] constexpr uint32_t texturesOf(MaterialFlags flags) {
    return static_cast<uint32_t>(flags >> 32U);
}

// Does not blend, and nothing is seen through it.
[[nodiscard]] constexpr bool isSolid(MaterialFlags flags) {
    return (flags & (io::kMaterialBlend | io::kMaterialTransmission)) == 0;
}
// Light passes it as through glass; what is blended, too, may be so.
[[nodiscard]] constexpr bool isTransmissive(MaterialFlags flags) {
    return (flags & io::kMaterialTransmission) != 0;
}

// Any texture: coordinates are fetched.
inline constexpr MaterialFlags kAnyTexture = ~MaterialFlags{0} << 32U;
// Whether shaders fetch coordinates; a direction on the surface is derived from them, too.
[[nodiscard]] constexpr bool fetchesCoordinates(MaterialFlags flags) {
    return (flags & (kAnyTexture | io::kMaterialAnisotropy)) != 0;
}
// What the dielectric part reflects, and what belongs to it.
inline constexpr MaterialFlags kSpecularFlags =
    MaterialFlags{io::kMaterialSpecular | io::kMaterialGlossiness} |
    textureFlag(io::specular_slot) | textureFlag(io::specular_color_slot);
// Light that passes as through glass, and what belongs to it.
inline constexpr MaterialFlags kTransmissionFlags =
    MaterialFlags{io::kMaterialTransmission | io::kMaterialBody | io::kMaterialDispersion |
                  io::kMaterialFrosted} |
    textureFlag(io::transmission_slot) | textureFlag(io::thickness_slot);
// Layers, and what belongs to them.
inline constexpr MaterialFlags kLayerFlags =
    MaterialFlags{io::kMaterialLayers} | kTransmissionFlags |
    (textureFlag(io::kMaterialSlots) - textureFlag(io::kSurfaceSlots));

// Over how many surfaces lights are added up where this is: a layer is one of its own.
[[nodiscard]] constexpr double litSurfaces(MaterialFlags flags) {
    return 1 + std::popcount(featuresOf(flags) & io::kMaterialLitLayers);
}

} // namespace froxel::render
