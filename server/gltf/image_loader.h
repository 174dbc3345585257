// The images of a scene, decoded on every core.
#pragma once

#include "gltf/buffer_views.h"
#include "gltf/document.h"
#include "gltf/failure.h"
#include "gltf/scene_folder.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace froxel::gltf {

// Fills `scene.images`; numbers[i] is the file's number of image i. All sizes are checked by their
// headers before the first pixel is decoded. An image that is missing or broken becomes a white
// pixel that no material uses, with a warning: their slots are emptied. Throws Failure for one that
// may not be read or is too large.
void loadImages(const Document& document,
                const std::vector<size_t>& numbers,
                SceneFolder& folder,
                BufferViews& views,
                scene::Scene& scene,
                Warnings& warnings);

} // namespace froxel::gltf
