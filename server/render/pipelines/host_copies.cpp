#include "render/pipelines/host_copies.h"

#include "render/pipelines/barrier.h"

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

} // namespace

void recordHostRead(const vk::raii::CommandBuffer& cmd) {
    barrier(cmd, Stage::eComputeShader | Stage::eCopy,
            Access::eShaderStorageWrite | Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

void recordTargetCopy(const vk::raii::CommandBuffer& cmd,
                      const gpu::Image& target,
                      vk::ImageAspectFlags aspect,
                      const gpu::Buffer& to,
                      vk::DeviceSize offset) {
    // the frame's last write of the target -> copy
    barrier(cmd, Stage::eAllCommands, Access::eMemoryWrite, Stage::eCopy, Access::eTransferRead);
    cmd.copyImageToBuffer(
        *target.handle, vk::ImageLayout::eGeneral, *to.handle,
        vk::BufferImageCopy{.bufferOffset = offset,
                            .imageSubresource = {aspect, 0, 0, 1},
                            .imageExtent = {target.extent.width, target.extent.height, 1}});
    recordHostRead(cmd);
}

} // namespace froxel::render
