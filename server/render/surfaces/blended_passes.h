// The passes of surfaces that are blended apart; as in passes.h, the order is in
// blended_recorder.cpp.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

void recordWeighted(const FrameContext& frame,
                    const vk::Rect2D& region); // tests depth; sums radiance and weights
// Of one layer, 0 the nearest, within the timestamps of "peel".
void recordPeelSelect(const FrameContext& frame,
                      const vk::Rect2D& region,
                      uint32_t layer); // reads solid depth and the last
                                       // keys; writes depth and keys
void recordPeelShade(const FrameContext& frame,
                     const vk::Rect2D& region,
                     uint32_t layer); // tests that depth, reads these
                                      // keys; blends under the sums
void recordPeelCount(const FrameContext& frame,
                     const vk::Rect2D& region,
                     uint32_t layers); // counts pixels with more layers
void recordBlendResolve(const FrameContext& frame,
                        const vk::Rect2D& region); // reads sums and weights, blends over radiance
void recordBlendOverUnlit(const FrameContext& frame,
                          const vk::Rect2D& region); // the same in compute, where some is unlit

} // namespace froxel::render
