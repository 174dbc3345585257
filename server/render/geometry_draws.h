// Draws of the scene's geometry, for the passes that raster it.
#pragma once

#include "render/frame_recorder.h"

#include <span>

namespace froxel::render {

// Within a rendering. layer: of the peeling passes, which also need their blend set bound.
void drawGroups(const FrameContext& frame,
                GeometryPass pass,
                std::span<const DrawGroup> groups,
                uint32_t layer = 0);

} // namespace froxel::render
