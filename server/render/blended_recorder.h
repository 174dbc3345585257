// The part of a frame that blends: which pass follows which, and the barriers between them.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

// After the solid surfaces' radiance and depth, in whatever stage; leaves radiance as a colour
// attachment's writes. The plan has something to blend.
void recordBlended(const FrameContext& frame);

// Layers that peeling draws: no pixel has more than there are triangles.
[[nodiscard]] uint32_t peelLayers(const FramePlan& plan, const DrawList& draws);

// Whether pixels with more layers are counted, since there can be any.
[[nodiscard]] bool countsOverflow(const FramePlan& plan, const DrawList& draws);

} // namespace froxel::render
