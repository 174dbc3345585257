// Which materials a scene's primitives have in its material variants (KHR_materials_variants).
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace froxel::scene {

// The scene as one without variants, whose primitives have the materials of this one. `number` is
// from 1; 0: none of them.
[[nodiscard]] Scene inMaterialVariant(Scene scene, uint32_t number);

} // namespace froxel::scene
