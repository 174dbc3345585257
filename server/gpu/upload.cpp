#include "gpu/upload.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::gpu {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;
using Layout = vk::ImageLayout;

// What outlives the caller's gpu::Image, which may move.
struct ImageTarget {
    vk::Image handle;
    vk::Extent2D extent;
    uint32_t mip_count;
};

void barrier(const vk::raii::CommandBuffer& cmd,
             const ImageTarget& image,
             uint32_t mip,
             Layout from,
             Layout to) {
    const vk::ImageMemoryBarrier2 transition{
        .srcStageMask = Stage::eAllTransfer,
        .srcAccessMask = from == Layout::eUndefined ? Access::eNone : Access::eTransferWrite,
        .dstStageMask = Stage::eAllCommands,
        .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite,
        .oldLayout = from,
        .newLayout = to,
        .image = image.handle,
        .subresourceRange = {vk::ImageAspectFlagBits::eColor, mip, 1, 0, 1}};
    cmd.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &transition});
}

vk::Offset3D mipCorner(const ImageTarget& image, uint32_t mip) {
    return {static_cast<int32_t>(std::max(1U, image.extent.width >> mip)),
            static_cast<int32_t>(std::max(1U, image.extent.height >> mip)), 1};
}

// A blit filters and converts; a software device takes that much longer for its texels.
constexpr vk::DeviceSize kBlitWeight = 4;
constexpr vk::DeviceSize kTexelBytes = 4;
constexpr vk::DeviceSize kAlignment = 16;

void blitLevel(const vk::raii::CommandBuffer& cmd, const ImageTarget& image, uint32_t mip) {
    barrier(cmd, image, mip - 1, Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal);
    const vk::ImageBlit blit{.srcSubresource = {vk::ImageAspectFlagBits::eColor, mip - 1, 0, 1},
                             .srcOffsets = std::array{vk::Offset3D{}, mipCorner(image, mip - 1)},
                             .dstSubresource = {vk::ImageAspectFlagBits::eColor, mip, 0, 1},
                             .dstOffsets = std::array{vk::Offset3D{}, mipCorner(image, mip)}};
    cmd.blitImage(image.handle, Layout::eTransferSrcOptimal, image.handle,
                  Layout::eTransferDstOptimal, blit, vk::Filter::eLinear);
}

} // namespace

Uploader::Uploader(const Device& device, vk::DeviceSize staging_bytes)
    : arena_(device),
      staging_(arena_.makeBuffer(
          staging_bytes, vk::BufferUsageFlagBits::eTransferSrc, MemoryUse::kUpload, "staging")) {}

Uploader::~Uploader() {
    if (on_device_) {
        (void)timeline_->wait(*on_device_); // a lost device has nothing left to wait for
    }
}

void Uploader::upload(const Buffer& target, std::span<const std::byte> data) {
    for (size_t done = 0; done < data.size();) {
        const size_t count = std::min<size_t>(data.size() - done, staging_.size_bytes);
        note({data.subspan(done, count), count,
              [staging = *staging_.handle, buffer = *target.handle, done,
               count](const auto& cmd, vk::DeviceSize offset) {
                  cmd.copyBuffer(
                      staging, buffer,
                      vk::BufferCopy{.srcOffset = offset, .dstOffset = done, .size = count});
              }});
        done += count;
    }
}

void Uploader::uploadImage(const Image& target,
                           std::span<const std::span<const std::byte>> levels) {
    const ImageTarget image{*target.handle, target.extent, target.mip_count};
    const auto given = static_cast<uint32_t>(levels.size());
    const auto step = [this](std::span<const std::byte> data, vk::DeviceSize cost, auto record) {
        note({data, cost, std::move(record)});
    };
    step({}, 0, [image](const auto& cmd, vk::DeviceSize /*offset*/) {
        for (uint32_t mip = 0; mip < image.mip_count; ++mip) {
            barrier(cmd, image, mip, Layout::eUndefined, Layout::eTransferDstOptimal);
        }
    });
    for (uint32_t mip = 0; mip < given; ++mip) { // in bands that fit
        const vk::Offset3D size = mipCorner(image, mip);
        const size_t row_bytes = levels[mip].size() / static_cast<size_t>(size.y);
        const auto most = static_cast<int32_t>(staging_.size_bytes / row_bytes);
        for (int32_t y = 0; y < size.y; y += most) {
            const int32_t rows = std::min(most, size.y - y);
            const auto band = levels[mip].subspan(row_bytes * static_cast<size_t>(y),
                                                  row_bytes * static_cast<size_t>(rows));
            step(band, band.size(),
                 [image, mip, y, rows, width = static_cast<uint32_t>(size.x),
                  staging = *staging_.handle](const auto& cmd, vk::DeviceSize offset) {
                     const vk::BufferImageCopy copy{
                         .bufferOffset = offset,
                         .imageSubresource = {vk::ImageAspectFlagBits::eColor, mip, 0, 1},
                         .imageOffset = {0, y, 0},
                         .imageExtent = {width, static_cast<uint32_t>(rows), 1}};
                     cmd.copyBufferToImage(staging, image.handle, Layout::eTransferDstOptimal,
                                           copy);
                 });
        }
    }
    for (uint32_t mip = given; mip < image.mip_count; ++mip) {
        const vk::Offset3D size = mipCorner(image, mip);
        step({}, kBlitWeight * kTexelBytes * static_cast<vk::DeviceSize>(size.x * size.y),
             [image, mip](const auto& cmd, vk::DeviceSize /*offset*/) {
                 blitLevel(cmd, image, mip);
             });
    }
    step({}, 0, [image, given](const auto& cmd, vk::DeviceSize /*offset*/) {
        for (uint32_t mip = 0; mip < image.mip_count; ++mip) {
            const bool was_source = mip + 1 >= given && mip + 1 < image.mip_count;
            const auto from =
                was_source ? Layout::eTransferSrcOptimal : Layout::eTransferDstOptimal;
            barrier(cmd, image, mip, from, Layout::eShaderReadOnlyOptimal);
        }
    });
}

bool Uploader::advance(Timeline& timeline) {
    if (on_device_ && timeline.completed() < *on_device_) {
        return false;
    }
    on_device_.reset(); // staging memory is free again
    if (steps_.empty()) {
        kept_.clear();
        return true;
    }
    cmd_ = timeline.makeCommandBuffer();
    cmd_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    vk::DeviceSize used = 0;
    vk::DeviceSize cost = 0;
    const auto fits = [&](const Step& step) {
        return used + step.data.size() <= staging_.size_bytes &&
               cost + step.cost <= staging_.size_bytes;
    };
    do {
        const Step& step = steps_.front();
        if (!step.data.empty()) {
            std::memcpy(staging_.mapped + used, step.data.data(), step.data.size());
        }
        step.record(cmd_, used);
        used += (step.data.size() + kAlignment - 1) / kAlignment * kAlignment;
        cost += step.cost;
        given_cost_ += step.cost;
        steps_.pop_front();
    } while (!steps_.empty() && fits(steps_.front()));
    cmd_.end();
    timeline_ = &timeline;
    on_device_ = timeline.submit(cmd_);
    return false;
}

void Uploader::note(Step step) {
    noted_cost_ += step.cost;
    steps_.push_back(std::move(step));
}

double Uploader::fraction() const {
    return noted_cost_ == 0 ? 1
                            : static_cast<double>(given_cost_) / static_cast<double>(noted_cost_);
}

void Uploader::finish(Timeline& timeline) {
    while (!advance(timeline)) {
        if (const auto done = timeline.wait(*on_device_); !done) {
            throw StartupError(done.error());
        }
    }
}

void uploadNow(const Device& device,
               Timeline& timeline,
               const Buffer& target,
               std::span<const std::byte> data) {
    Uploader uploader(device, data.size());
    uploader.upload(target, data);
    uploader.finish(timeline);
}

} // namespace froxel::gpu
