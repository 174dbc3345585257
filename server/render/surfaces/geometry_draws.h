// Draws of the scene's geometry, for the passes that raster it.
#pragma once

#include "render/frame/frame_context.h"

#include <functional>
#include <span>

namespace froxel::render {

// Vertices, indices and set 0. `rows`: of the draws' instances in the frame's upload.
void bindGeometry(const FrameContext& frame,
                  vk::PipelineLayout layout,
                  vk::DescriptorSet frame_set,
                  vk::Buffer indices,
                  vk::DeviceSize rows);

// inShares() of a pass's groups: several renderings then, of which those that are not the first
// load what is there.
void inGroups(const FrameContext& frame,
              GeometryPass pass,
              std::span<const DrawGroup> groups,
              const std::function<void(std::span<const DrawGroup>, bool first)>& record);

// Within a rendering. layer: of passes that draw several, which also need their set 2 bound.
void drawGroups(const FrameContext& frame,
                GeometryPass pass,
                std::span<const DrawGroup> groups,
                uint32_t layer = 0);

} // namespace froxel::render
