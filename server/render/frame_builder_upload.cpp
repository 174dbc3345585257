// What a frame's host data becomes on the device.
#include "area_light_table/table.h"
#include "render/frame_builder.h"

#include <array>
#include <memory>
#include <span>

namespace froxel::render {

void FrameBuilder::gather(FrameUpload& upload, std::span<const ActiveEffect> effects) {
    upload.clear();
    blocks_ = {};
    const auto place = [&](size_t binding, auto span) {
        blocks_[binding] =
            span.empty() ? FrameBlock{} : FrameBlock{upload.add(span), span.size_bytes()};
    };
    place(0, std::span<const io::Frame>(&uniforms_, 1));
    place(1, std::span<const io::Light>(lights_.lights));
    place(2, std::span<const io::ClusterList>(lists_.clusters));
    place(3, std::span<const uint32_t>(lists_.indices));
    place(4, std::span<const io::Spot>(lights_.spots));
    place(5, std::span<const io::DirectionalLight>(lights_.directionals));
    place(11, std::span<const io::AreaLight>(lights_.areas));
    assign_offsets_ = on_device_ ? gatherAssignment(upload) : AssignOffsets{};
    UploadOffsets& offsets = offsets_;
    offsets = {};
    offsets.rows = upload.add(std::span<const InstanceRows>(draws_.rows));
    if (!draws_.indices.empty()) {
        // lavapipe 22.3 ignores an index buffer's offset in indirect draws: count from 0 instead.
        const auto first = upload.add(std::span<const uint32_t>(draws_.indices)) / sizeof(uint32_t);
        for (auto& command : draws_.commands) {
            command.firstIndex += static_cast<uint32_t>(first);
        }
    }
    if (visibility_) {
        offsets.instances = upload.add(std::span<const io::InstanceView>(instances_));
        offsets.meshlet_order = upload.add(std::span<const uint32_t>(meshlet_order_));
    }
    if (!debug_.wires.empty()) {
        offsets.wires = upload.add(std::span<const io::WireVertex>(debug_.wires));
    }
    offsets.commands = upload.add(std::span<const vk::DrawIndexedIndirectCommand>(draws_.commands));
    for (const ActiveEffect& active : effects) {
        active.effect->gather(upload, blocks_);
    }
}

AssignOffsets FrameBuilder::gatherAssignment(FrameUpload& upload) const {
    const AssignData& data = device_lists_.data();
    return {.frame = upload.add(std::span<const io::AssignFrame>(data.frame)),
            .tables = upload.add(std::span<const double>(data.tables)),
            .lights = blocks_[1].offset,
            .radii = upload.add(data.radii_m),
            .spots = upload.add(std::span<const io::AssignSpot>(data.spots))};
}

UploadOffsets FrameBuilder::upload(FrameSlot& slot, std::span<const ActiveEffect> effects) {
    slot.upload.commit();
    for (const ActiveEffect& active : effects) {
        active.effect->prepare(slot, blocks_);
    }
    if (!lights_.areas.empty()) {
        const gpu::Buffer& table = scene_.ltcTable();
        blocks_[12] = {.bytes = area_light_table::table().size_bytes(), .buffer = *table.handle};
    }
    slot.device_lists = on_device_;
    if (on_device_) {
        writeAssignment(slot);
    }
    writeFrameSet(slot);
    return offsets_;
}

void FrameBuilder::writeAssignment(FrameSlot& slot) {
    const auto& buffers = device_lists_.makeBuffers();
    blocks_[2] = {.bytes = device_lists_.data().frame[0].cluster_count * sizeof(io::ClusterList),
                  .buffer = *buffers->lists.handle};
    blocks_[3] = {.bytes = uint64_t{buffers->capacity.entries} * sizeof(uint32_t),
                  .buffer = *buffers->indices.handle};
    if (!slot.assignment) {
        slot.assignment = std::make_unique<AssignSlot>(scene_.device, *scene_.assignment());
    }
    slot.assignment->write(buffers, device_lists_.data(), slot.upload.buffer(), assign_offsets_);
}

void FrameBuilder::writeFrameSet(FrameSlot& slot) const {
    std::array<vk::DescriptorBufferInfo, Pipelines::kFrameBindings> infos;
    std::array<vk::DescriptorImageInfo, Pipelines::kFrameBindings> images;
    std::array<vk::BufferView, Pipelines::kFrameBindings> views;
    std::array<vk::WriteDescriptorSet, Pipelines::kFrameBindings> writes;
    slot.texel_views.clear();
    for (uint32_t i = 0; i < infos.size(); ++i) {
        // What the frame lacks is described as none.
        const auto& [offset, bytes, own, image] = blocks_[i];
        const vk::Buffer buffer = own ? own : slot.upload.buffer();
        infos[i] = bytes > 0 ? vk::DescriptorBufferInfo{buffer, offset, bytes}
                             : vk::DescriptorBufferInfo{.buffer = {}, .range = VK_WHOLE_SIZE};
        images[i] = {.imageView = image, .imageLayout = vk::ImageLayout::eGeneral};
        writes[i] = {.dstSet = *slot.frame_set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = Pipelines::kFrameBindingTypes[i],
                     .pImageInfo = &images[i],
                     .pBufferInfo = &infos[i]};
        if (Pipelines::kFrameTexelFormats[i] != vk::Format::eUndefined) {
            if (bytes > 0) {
                slot.texel_views.push_back(scene_.device.handle().createBufferView(
                    {.buffer = buffer,
                     .format = Pipelines::kFrameTexelFormats[i],
                     .offset = offset,
                     .range = bytes}));
                views[i] = *slot.texel_views.back();
            }
            writes[i].pTexelBufferView = &views[i];
        }
    }
    scene_.device.handle().updateDescriptorSets(writes, {});
}

ListCapacity FrameBuilder::listCapacity() const {
    // Kept for the next frame that has its lists made there.
    return on_device_                ? device_lists_.capacity()
           : device_lists_.buffers() ? device_lists_.buffers()->capacity
                                     : ListCapacity{};
}

uint64_t FrameBuilder::hostBytes() const {
    const auto kept = [](const auto& items) { return items.capacity() * sizeof(items[0]); };
    uint64_t bytes = kept(lists_.clusters) + kept(lists_.indices);
    for (const auto* lights : {&lights_, &grown_, &wire_lights_}) {
        bytes += kept(lights->lights) + kept(lights->radii_m) + kept(lights->spots) +
                 kept(lights->cones);
    }
    return bytes;
}

void FrameBuilder::letGo() {
    lists_ = {};
    lights_ = {};
    grown_ = {};
    wire_lights_ = {};
}

} // namespace froxel::render
