// The hall's procedural surfaces, one function each; textures tile unless said otherwise.
#pragma once

#include "builtin_scene/texture.h"

namespace froxel::builtin_scene {

// recipes_stone.cpp
[[nodiscard]] Recipe ashlarRecipe();
[[nodiscard]] Recipe limestoneRecipe();
[[nodiscard]] Recipe plasterRecipe();
[[nodiscard]] Recipe pavonazzettoRecipe();
[[nodiscard]] Recipe verdeRecipe();
[[nodiscard]] Recipe rossoRecipe();
[[nodiscard]] Recipe gialloRecipe();

// recipes_floor.cpp
[[nodiscard]] Recipe inlayRecipe();
[[nodiscard]] Recipe herringboneRecipe();
[[nodiscard]] Recipe mosaicRecipe();
[[nodiscard]] Recipe starsRecipe();

// recipes_craft.cpp
[[nodiscard]] Recipe bronzeRecipe();
[[nodiscard]] Recipe woodRecipe();
[[nodiscard]] Recipe clothRecipe();
[[nodiscard]] Recipe terracottaRecipe();
[[nodiscard]] Recipe soilRecipe();
[[nodiscard]] Recipe waterRecipe();

// recipes_cutout.cpp: alpha-masked or glazed; leaves do not tile.
[[nodiscard]] Recipe ivyRecipe();
[[nodiscard]] Recipe fernRecipe();
[[nodiscard]] Recipe grilleRecipe();
[[nodiscard]] Recipe stainedGlassRecipe();

} // namespace froxel::builtin_scene
