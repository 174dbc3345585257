// The passes of a frame. Each records one debug label with two timestamps of the same name into the
// slot's command buffer, and no barrier; the order is in frame_recorder.cpp.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

void recordPoseVertices(const FrameContext& frame);    // writes vertices that bend
void recordPoseFlatNormals(const FrameContext& frame); // reads and writes these
void recordDepthPrepass(const FrameContext& frame, const vk::Rect2D& region); // writes depth
void recordForwardPass(const FrameContext& frame,
                       const vk::Rect2D& region); // writes radiance, depth where no prepass did
void recordGbuffer(const FrameContext& frame, const vk::Rect2D& region); // writes G-buffer, depth
void recordLightingCompute(const FrameContext& frame,
                           const vk::Rect2D& region); // reads both; writes radiance and/or pixels
void recordLightingFragment(const FrameContext& frame,
                            const vk::Rect2D& region); // reads both; writes radiance
void recordLayers(const FrameContext& frame,
                  const vk::Rect2D& region); // writes radiance where depth is equal
void recordToon(const FrameContext& frame,
                const vk::Rect2D& region); // reads radiance; writes radiance and/or pixels
void recordOutline(const FrameContext& frame,
                   const vk::Rect2D& region); // reads depth and G-buffer; darkens radiance
void recordTransparent(const FrameContext& frame,
                       const vk::Rect2D& region); // blends over radiance, tests depth
void recordTonemap(const FrameContext& frame,
                   const vk::Rect2D& region); // reads radiance, writes pixels
void recordOverdraw(const FrameContext& frame,
                    const vk::Rect2D& region); // writes depth; adds fragments up in radiance
void recordDebugView(const FrameContext& frame,
                     const vk::Rect2D& region); // reads what the view shows, writes pixels
// Blend lines over radiance, read depth.
void recordLightWires(const FrameContext& frame, uint32_t first_light, uint32_t light_count);
void recordClusterWires(const FrameContext& frame, uint32_t first_line, uint32_t line_count);
void recordCountPairs(const FrameContext& frame, const vk::Rect2D& region); // reads depth
void recordReadback(const FrameContext& frame); // copies pixels to the host
void recordRadianceReadback(const FrameContext& frame, const vk::Rect2D& region); // likewise

} // namespace froxel::render
