// The images of a scene, decoded on every core.
#pragma once

#include "gltf/buffer_views.h"
#include "gltf/document.h"
#include "gltf/failure.h"
#include "gltf/load_progress.h"
#include "gltf/scene_files.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace froxel::gltf {

// Fills `scene.images`; sources[i] are the file's images that may be image i, the best first: it
// becomes the first of them that can be read, and those behind it are not touched. Sizes are
// checked by their headers before the first pixel is decoded. An image of which none can be read
// becomes a white pixel that no material uses: their slots are emptied. Each that cannot be read is
// a warning. Throws Failure for one that may not be read or is too large;
// CalledOff.
void loadImages(const Document& document,
                const std::vector<std::vector<size_t>>& sources,
                SceneFiles& files,
                BufferViews& views,
                LoadProgress& progress,
                ReadMemory& memory,
                scene::Scene& scene,
                Warnings& warnings);

} // namespace froxel::gltf
