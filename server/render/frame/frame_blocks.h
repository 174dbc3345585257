// Where the bindings of a frame's set find their data.
#pragma once

#include "render/pipelines/pipelines.h"

#include <array>

namespace froxel::render {

struct FrameBlock {
    vk::DeviceSize offset = 0;
    vk::DeviceSize bytes = 0; // 0: the frame lacks it
    vk::Buffer buffer = {};   // null: the upload buffer
    vk::ImageView image = {}; // of an image's binding; null: the frame lacks it
};

using FrameBlocks = std::array<FrameBlock, io::kFrameBindingCount>;

} // namespace froxel::render
