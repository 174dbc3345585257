// Fills a scene with the hall's materials, textures and images, in the order of Surface.
#pragma once

#include "scene/scene.h"

namespace froxel::builtin_scene {

void addMaterials(scene::Scene& scene);

} // namespace froxel::builtin_scene
