// The passes of fog, as those of passes.h.
#pragma once

#include "render/frame_context.h"

namespace froxel::render {

void recordFogScatter(const FrameContext& frame,
                      const vk::Rect2D& nodes);     // reads lights and lists; writes the volume
void recordFogIntegrate(const FrameContext& frame); // adds it up from front to back
void recordFogApply(const FrameContext& frame,
                    const vk::Rect2D& region); // reads volume and depth; radiance seen through fog

} // namespace froxel::render
