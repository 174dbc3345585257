#include "render/frame/frame_slot.h"

#include "gpu/pipeline.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::render {

namespace {

vk::raii::DescriptorPool makePool(const gpu::Device& device) {
    using Type = vk::DescriptorType;
    const std::array sizes = {
        vk::DescriptorPoolSize{Type::eUniformBuffer, 3},
        vk::DescriptorPoolSize{Type::eUniformTexelBuffer, io::kFrameBindingCount},
        vk::DescriptorPoolSize{Type::eStorageBuffer, 2},
        vk::DescriptorPoolSize{Type::eSampledImage, 4},
        vk::DescriptorPoolSize{Type::eStorageImage, 1}};
    return gpu::makeDescriptorPool(device, sizes, 2);
}

vk::DeviceSize uploadAlignment(const gpu::Device& device) {
    const auto& limits = device.limits();
    return std::max({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment,
                     limits.minTexelBufferOffsetAlignment, vk::DeviceSize{16}});
}

} // namespace

FrameUpload::FrameUpload(const gpu::Device& device)
    : device_(device), alignment_(uploadAlignment(device)) {}

vk::DeviceSize FrameUpload::addBytes(std::span<const std::byte> bytes) {
    const vk::DeviceSize offset = used_bytes_;
    pieces_.push_back({offset, bytes});
    // Even an absent piece gets an address of its own, for descriptors that nothing reads.
    const auto size = std::max<vk::DeviceSize>(bytes.size(), alignment_);
    used_bytes_ = (offset + size + alignment_ - 1) / alignment_ * alignment_;
    return offset;
}

vk::DeviceSize FrameUpload::sizeFor(vk::DeviceSize bytes) const {
    // Room to grow into, and no more than that is kept idle.
    constexpr vk::DeviceSize kMostRoom = vk::DeviceSize{4} << 20U;
    constexpr vk::DeviceSize kNeverTooLarge = vk::DeviceSize{1} << 20U;
    const auto had = buffer_.size_bytes;
    const bool too_large = had > kNeverTooLarge && had > 2 * bytes + kMostRoom;
    return had >= bytes && had > 0 && !too_large ? had : bytes + std::min(bytes / 2, kMostRoom);
}

void FrameUpload::trim(vk::DeviceSize bytes) {
    if (sizeFor(bytes) < buffer_.size_bytes) {
        buffer_ = {};
        arena_.reset();
    }
}

void FrameUpload::commit() {
    const auto size = sizeFor(used_bytes_);
    if (size != buffer_.size_bytes) {
        using Usage = vk::BufferUsageFlagBits;
        buffer_ = {};
        arena_.reset(); // before its successor takes memory
        arena_ = std::make_unique<gpu::MemoryArena>(device_);
        buffer_ = arena_->makeBuffer(size,
                                     Usage::eUniformBuffer | Usage::eStorageBuffer |
                                         Usage::eUniformTexelBuffer | Usage::eVertexBuffer |
                                         Usage::eIndexBuffer | Usage::eIndirectBuffer,
                                     gpu::MemoryUse::kUpload, "frame upload");
    }
    for (const auto& piece : pieces_) {
        if (!piece.bytes.empty()) {
            std::memcpy(buffer_.mapped + piece.offset, piece.bytes.data(), piece.bytes.size());
        }
    }
}

void FrameUpload::clear() {
    pieces_.clear();
    used_bytes_ = 0;
}

Readback::Readback(const gpu::Device& device, const ReadbackBytes& its_bytes)
    : bytes(its_bytes), arena(device),
      buffer(arena.makeBuffer(bytes.picture,
                              vk::BufferUsageFlagBits::eStorageBuffer |
                                  vk::BufferUsageFlagBits::eTransferDst,
                              gpu::MemoryUse::kReadback,
                              "readback")) {
    for (size_t i = 0; i < kOutputCount; ++i) {
        if (bytes.outputs[i] > 0) {
            outputs[i] = arena.makeBuffer(
                bytes.outputs[i],
                vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst,
                gpu::MemoryUse::kReadback, std::string(kOutputRows[i].name) + " readback");
        }
    }
}

FrameSlot::FrameSlot(DeviceResources& shared)
    : cmd(shared.timeline.makeCommandBuffer()), pieces(shared.timeline, cmd),
      host_copy(shared.copies ? &*shared.copies : nullptr), timestamps(shared.device),
      upload(shared.device), pool(makePool(shared.device)) {
    frame_set = gpu::makeSet(shared.device, pool, shared.pipelines.frameLayout());
    screen_set = gpu::makeSet(shared.device, pool, shared.pipelines.screenLayout());
}

void FrameSlot::makeReadback(const gpu::Device& device, const ReadbackBytes& bytes) {
    if (!readback || readback->bytes != bytes) {
        readback.reset(); // before its successor takes memory
        readback = std::make_shared<Readback>(device, bytes);
    }
}

void FrameSlot::letGo(const ReadbackBytes& readback_bytes, vk::DeviceSize upload_bytes) {
    targets.reset();
    step_targets.clear();
    if (readback && readback->bytes != readback_bytes) {
        readback.reset(); // a lease keeps its own
    }
    if (assignment) {
        assignment->letGo();
    }
    upload.trim(upload_bytes);
}

const gpu::Buffer& pixelsOf(const FrameSlot& slot) {
    return slot.targets->needs.device_pixels ? slot.targets->pixels : slot.readback->buffer;
}

const gpu::Buffer& packedPixels(const FrameSlot& slot, Resource what) {
    return what == Resource::kDisplay    ? slot.targets->display[0]
           : what == Resource::kDisplay2 ? slot.targets->display[1]
                                         : pixelsOf(slot);
}

void writeFrameSet(const gpu::Device& device, FrameSlot& slot, const FrameBlocks& blocks) {
    std::array<vk::DescriptorBufferInfo, io::kFrameBindingCount> infos;
    std::array<vk::DescriptorImageInfo, io::kFrameBindingCount> images;
    std::array<vk::BufferView, io::kFrameBindingCount> views;
    std::array<vk::WriteDescriptorSet, io::kFrameBindingCount> writes;
    slot.texel_views.clear();
    for (uint32_t i = 0; i < infos.size(); ++i) {
        // What the frame lacks is described as none.
        const auto& [offset, bytes, own, image] = blocks[i];
        const vk::Buffer buffer = own ? own : slot.upload.buffer();
        infos[i] = bytes > 0 ? vk::DescriptorBufferInfo{buffer, offset, bytes}
                             : vk::DescriptorBufferInfo{.buffer = {}, .range = VK_WHOLE_SIZE};
        images[i] = {.imageView = image, .imageLayout = vk::ImageLayout::eGeneral};
        writes[i] = {.dstSet = *slot.frame_set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = kFrameBindings[i].type,
                     .pImageInfo = &images[i],
                     .pBufferInfo = &infos[i]};
        if (kFrameBindings[i].texels != vk::Format::eUndefined) {
            if (bytes > 0) {
                slot.texel_views.push_back(
                    device.handle().createBufferView({.buffer = buffer,
                                                      .format = kFrameBindings[i].texels,
                                                      .offset = offset,
                                                      .range = bytes}));
                views[i] = *slot.texel_views.back();
            }
            writes[i].pTexelBufferView = &views[i];
        }
    }
    device.handle().updateDescriptorSets(writes, {});
}

void writeScreenSet(const gpu::Device& device, FrameSlot& slot, const gpu::Buffer& packed) {
    const auto image = [](const gpu::Image& target) {
        return vk::DescriptorImageInfo{.imageView = *target.view,
                                       .imageLayout = vk::ImageLayout::eGeneral};
    };
    const auto& t = *slot.targets;
    // lavapipe binds all of a set, also what no shader of the pass reads: an absent target must not
    // leave the freed image of an earlier size behind, so it is described as none.
    const std::array images = {image(t.gbuffer), image(t.solidDepth()), image(t.radiance),
                               image(t.gbuffer_extra)};
    const vk::DescriptorBufferInfo buffer{*packed.handle, 0, VK_WHOLE_SIZE};
    std::vector<vk::WriteDescriptorSet> writes;
    const auto add = [&](uint32_t binding, vk::DescriptorType type) -> vk::WriteDescriptorSet& {
        writes.push_back({.dstSet = *slot.screen_set,
                          .dstBinding = binding,
                          .descriptorCount = 1,
                          .descriptorType = type});
        return writes.back();
    };
    add(0, vk::DescriptorType::eSampledImage).pImageInfo = &images[0];
    add(1, vk::DescriptorType::eSampledImage).pImageInfo = &images[1];
    add(2, vk::DescriptorType::eStorageImage).pImageInfo = &images[2];
    add(3, vk::DescriptorType::eStorageBuffer).pBufferInfo = &buffer;
    add(4, vk::DescriptorType::eSampledImage).pImageInfo = &images[3];
    device.handle().updateDescriptorSets(writes, {});
}

} // namespace froxel::render
