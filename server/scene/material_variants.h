// Which materials a scene's primitives have in its material variants (KHR_materials_variants).
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>

namespace froxel::scene {

// The material in a variant, `number` from 1, of a primitive whose own is `own`.
[[nodiscard]] uint32_t
materialIn(uint32_t number, uint32_t own, std::span<const VariantMaterial> others);

// The scene as one without variants, whose primitives have the materials of this one. `number` is
// from 1; 0: none of them.
[[nodiscard]] Scene inMaterialVariant(Scene scene, uint32_t number);

} // namespace froxel::scene
