// The built-in scene: a colonnaded hall made by code, the same on every machine.
#pragma once

#include "scene/scene.h"

namespace froxel::builtin_scene {

[[nodiscard]] scene::Scene makeHall();

} // namespace froxel::builtin_scene
