// Puts a parsed file together: nodes to instances, cameras and lights; then the images.
#pragma once

#include "gltf/document.h"
#include "gltf/load_progress.h"
#include "gltf/scene_files.h"
#include "scene/scene.h"

namespace froxel::gltf {

// Throws Failure, CalledOff.
[[nodiscard]] scene::Scene buildScene(const Document& document,
                                      SceneFiles& files,
                                      LoadProgress& progress,
                                      ReadMemory& memory,
                                      Warnings& warnings);

} // namespace froxel::gltf
