#include "gpu/upload.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::gpu {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;
using Layout = vk::ImageLayout;

void barrier(
    const vk::raii::CommandBuffer& cmd, const Image& image, uint32_t mip, Layout from, Layout to) {
    const vk::ImageMemoryBarrier2 transition{
        .srcStageMask = Stage::eAllTransfer,
        .srcAccessMask = from == Layout::eUndefined ? Access::eNone : Access::eTransferWrite,
        .dstStageMask = Stage::eAllCommands,
        .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite,
        .oldLayout = from,
        .newLayout = to,
        .image = *image.handle,
        .subresourceRange = {vk::ImageAspectFlagBits::eColor, mip, 1, 0, 1}};
    cmd.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &transition});
}

vk::Offset3D mipCorner(const Image& image, uint32_t mip) {
    return {static_cast<int32_t>(std::max(1U, image.extent.width >> mip)),
            static_cast<int32_t>(std::max(1U, image.extent.height >> mip)), 1};
}

} // namespace

Uploader::Uploader(const Device& device, Timeline& timeline, vk::DeviceSize staging_bytes)
    : device_(device), timeline_(timeline), arena_(device) {
    grow(staging_bytes);
}

void Uploader::grow(vk::DeviceSize bytes) {
    staging_ = arena_.makeBuffer(bytes, vk::BufferUsageFlagBits::eTransferSrc, MemoryUse::kUpload,
                                 "staging");
}

void Uploader::upload(const Buffer& target, std::span<const std::byte> data) {
    for (size_t done = 0; done < data.size();) {
        const size_t count = std::min<size_t>(data.size() - done, staging_.size_bytes);
        std::memcpy(staging_.mapped, data.data() + done, count);
        timeline_.runNow([&](const auto& cmd) {
            cmd.copyBuffer(*staging_.handle, *target.handle,
                           vk::BufferCopy{.srcOffset = 0, .dstOffset = done, .size = count});
        });
        done += count;
    }
}

void Uploader::uploadImage(const Image& target, std::span<const std::byte> texels) {
    if (texels.size() > staging_.size_bytes) {
        grow(texels.size());
    }
    std::memcpy(staging_.mapped, texels.data(), texels.size());
    timeline_.runNow([&](const auto& cmd) {
        for (uint32_t mip = 0; mip < target.mip_count; ++mip) {
            barrier(cmd, target, mip, Layout::eUndefined, Layout::eTransferDstOptimal);
        }
        cmd.copyBufferToImage(
            *staging_.handle, *target.handle, Layout::eTransferDstOptimal,
            vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                .imageExtent = {target.extent.width, target.extent.height, 1}});
        for (uint32_t mip = 1; mip < target.mip_count; ++mip) {
            barrier(cmd, target, mip - 1, Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal);
            const vk::ImageBlit blit{
                .srcSubresource = {vk::ImageAspectFlagBits::eColor, mip - 1, 0, 1},
                .srcOffsets = std::array{vk::Offset3D{}, mipCorner(target, mip - 1)},
                .dstSubresource = {vk::ImageAspectFlagBits::eColor, mip, 0, 1},
                .dstOffsets = std::array{vk::Offset3D{}, mipCorner(target, mip)}};
            cmd.blitImage(*target.handle, Layout::eTransferSrcOptimal, *target.handle,
                          Layout::eTransferDstOptimal, blit, vk::Filter::eLinear);
        }
        for (uint32_t mip = 0; mip < target.mip_count; ++mip) {
            const auto from = mip + 1 < target.mip_count ? Layout::eTransferSrcOptimal
                                                         : Layout::eTransferDstOptimal;
            barrier(cmd, target, mip, from, Layout::eShaderReadOnlyOptimal);
        }
    });
}

} // namespace froxel::gpu
