// Fills a scene with the hall's materials, textures and images, in the order of Surface.
#pragma once

#include "scene/scene.h"

namespace froxel::hall {

void addMaterials(scene::Scene& scene);

} // namespace froxel::hall
