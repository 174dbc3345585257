// The visibility passes: culling, which triangle each pixel shows, and what that looks like. No
// barrier is here.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

void recordEmptyDraws(const FrameContext& frame); // where draws cannot be counted on the device
// Writes ranks and counts of the visible meshlets; culls: not of all.
void recordCull(const FrameContext& frame, bool culls);
void recordCompact(const FrameContext& frame); // reads those; writes draws and their counts
void recordVisibility(const FrameContext& frame,
                      const vk::Rect2D& region); // reads draws; writes depth, ids
void recordVisibilityGbuffer(const FrameContext& frame,
                             const vk::Rect2D& region); // reads depth, ids; writes G-buffer
// Reads depth, ids; writes radiance, pixels, as output_flags say.
void recordVisibilityShade(const FrameContext& frame,
                           const vk::Rect2D& region,
                           uint32_t output_flags);
// Of surfaces that transmit light, whose layers were rastered in compute: one of them, over the
// picture. Reads words, the picture behind; writes radiance. behind: with the layout of
// Pipelines::transmissionSetLayout(). tiles: of layers, where all of it is to be drawn; else none.
void recordVisibilityTransmission(const FrameContext& frame,
                                  const vk::Rect2D& region,
                                  vk::DescriptorSet behind,
                                  uint32_t layer,
                                  vk::Buffer tiles);
// Of surfaces with layers, over what lighting left of them.
void recordVisibilityLayers(const FrameContext& frame,
                            const vk::Rect2D& region); // reads depth, ids; writes radiance

} // namespace froxel::render
