// The five named views, and the hall's own lights.
#pragma once

#include "scene/scene.h"

namespace froxel::builtin_scene {

void addCameras(scene::Scene& scene);
void addLights(scene::Scene& scene);

} // namespace froxel::builtin_scene
