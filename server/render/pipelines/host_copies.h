// What the host reads of a device's work.
#pragma once

#include "gpu/memory.h"

namespace froxel::render {

// What compute shaders and copies wrote -> the host, once the commands have completed.
void recordHostRead(const vk::raii::CommandBuffer& cmd);

// Copies a target that frames draw into, as it is, to a place in a host buffer, for after a frame.
void recordTargetCopy(const vk::raii::CommandBuffer& cmd,
                      const gpu::Image& target,
                      vk::ImageAspectFlags aspect,
                      const gpu::Buffer& to,
                      vk::DeviceSize offset = 0);

} // namespace froxel::render
