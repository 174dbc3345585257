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

void Uploader::uploadImage(const Image& target,
                           std::span<const std::span<const std::byte>> levels) {
    std::vector<vk::BufferImageCopy> copies;
    vk::DeviceSize bytes = 0;
    for (const std::span<const std::byte> texels : levels) {
        const auto mip = static_cast<uint32_t>(copies.size());
        const vk::Offset3D size = mipCorner(target, mip);
        copies.push_back(
            {.bufferOffset = bytes,
             .imageSubresource = {vk::ImageAspectFlagBits::eColor, mip, 0, 1},
             .imageExtent = {static_cast<uint32_t>(size.x), static_cast<uint32_t>(size.y), 1}});
        bytes += texels.size();
    }
    if (bytes > staging_.size_bytes) {
        grow(bytes);
    }
    for (size_t i = 0; i < levels.size(); ++i) {
        std::memcpy(staging_.mapped + copies[i].bufferOffset, levels[i].data(), levels[i].size());
    }
    timeline_.runNow([&](const auto& cmd) {
        for (uint32_t mip = 0; mip < target.mip_count; ++mip) {
            barrier(cmd, target, mip, Layout::eUndefined, Layout::eTransferDstOptimal);
        }
        cmd.copyBufferToImage(*staging_.handle, *target.handle, Layout::eTransferDstOptimal,
                              copies);
        const auto given = static_cast<uint32_t>(levels.size());
        for (uint32_t mip = given; mip < target.mip_count; ++mip) {
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
            const bool was_source = mip + 1 >= given && mip + 1 < target.mip_count;
            const auto from =
                was_source ? Layout::eTransferSrcOptimal : Layout::eTransferDstOptimal;
            barrier(cmd, target, mip, from, Layout::eShaderReadOnlyOptimal);
        }
    });
}

} // namespace froxel::gpu
