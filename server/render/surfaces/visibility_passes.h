// The visibility passes: culling, which triangle each pixel shows, and what that looks like. As in
// passes.h no barrier is here.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

void recordEmptyDraws(const FrameContext& frame); // where draws cannot be counted on the device
void recordCull(const FrameContext& frame);       // writes ranks and counts of the visible meshlets
void recordCompact(const FrameContext& frame);    // reads those; writes draws and their counts
void recordVisibility(const FrameContext& frame,
                      const vk::Rect2D& region); // reads draws; writes depth, ids
void recordVisibilityGbuffer(const FrameContext& frame,
                             const vk::Rect2D& region); // reads depth, ids; writes G-buffer
void recordVisibilityShade(const FrameContext& frame,
                           const vk::Rect2D& region); // reads depth, ids; writes radiance, pixels
// Of surfaces with layers, over what lighting left of them.
void recordVisibilityLayers(const FrameContext& frame,
                            const vk::Rect2D& region); // reads depth, ids; writes radiance

} // namespace froxel::render
