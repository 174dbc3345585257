#include "render/frame_builder.h"

#include "cluster/depth_range.h"

#include <algorithm>
#include <array>
#include <future>
#include <span>

namespace froxel::render {

namespace {

// Farthest depth of the scene along the view direction, for orthographic cameras.
double farthestDepth(const view::Camera& camera, const BoundsD3& bounds) {
    double farthest = 0;
    for (uint32_t i = 0; i < 8 && !bounds.empty(); ++i) {
        const glm::dvec3 corner((i & 1U) != 0 ? bounds.max.x : bounds.min.x,
                                (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
                                (i & 4U) != 0 ? bounds.max.z : bounds.min.z);
        farthest =
            std::max(farthest, -glm::dot(corner - camera.eye_world, camera.world_from_view[2]));
    }
    return farthest * 1.001;
}

} // namespace

FrameFacts FrameBuilder::facts(const FrameInputs& inputs) const {
    const auto& traits = scene_.device.traits();
    return {.wide_gbuffer = scene_.needs.wide_gbuffer,
            .transparent_visible = !draws_.transparent.empty(),
            .local_lights = !lights_.lights.empty(),
            .spots = !lights_.spots.empty(),
            .directional = !lights_.directionals.empty(),
            .keep_radiance = inputs.keep_radiance,
            .all_lights = inputs.settings.light_loop == view::LightLoop::kAllLights,
            .compute_batches = traits.subgroup_size > 1,
            // Elsewhere a subgroup of fragments may lack some of its invocations at any time.
            .fragment_batches = traits.is_cpu && traits.fragment_subgroups};
}

void FrameBuilder::assignLights(const view::ViewSettings& settings, bool lists) {
    if (!lists) {
        lists_.clusters.clear();
        lists_.indices.clear();
        lists_.stats = {};
        lists_.stats.light_count = static_cast<uint32_t>(lights_.lights.size());
        return;
    }
    const auto& camera = settings.camera;
    const auto range = cluster::litDepthRange(lights_, camera, scene_.bounds_world);
    grid_ =
        cluster::makeClusterGrid({settings.grid.size, settings.grid.law}, settings.size, camera, range.near_m, range.far_m);
    scene_.light_assigner.assign(grid_, lights_, lists_);
}

FramePlan FrameBuilder::build(const FrameInputs& inputs) {
    const auto& settings = inputs.settings;
    const auto& camera = settings.camera;
    const auto projection =
        makeProjection(camera, settings.size, farthestDepth(camera, scene_.bounds_world));
    // Culling and light assignment do not need each other: 7 becomes 5 ms on two cores (Sponza).
    auto culling = std::async(std::launch::async, [&] {
        buildDrawList(scene_, camera, settings.size, projection, scene_.device.traits().is_cpu,
                      draws_);
    });
    scene_.light_rig.evaluate(settings.lights, camera, inputs.time_s, lights_);
    const bool lists = needsLists(settings.renderer, !lights_.lights.empty(), settings.light_loop == view::LightLoop::kAllLights);
    assignLights(settings, lists);
    culling.get();
    planned_ = generalised(facts(inputs), inputs.generic);
    const FramePlan plan = planFrame(settings, planned_);
    uniforms_ = makeFrameUniforms(settings, projection, plan.lists ? &grid_ : nullptr,
                                  static_cast<uint32_t>(lights_.lights.size()),
                                  static_cast<uint32_t>(lights_.directionals.size()));
    return plan;
}

UploadOffsets FrameBuilder::upload(FrameSlot& slot) {
    auto& upload = slot.upload;
    upload.clear();
    Blocks blocks;
    const auto place = [&](size_t binding, auto span) {
        blocks[binding] = span.empty() ? Block{} : Block{upload.add(span), span.size_bytes()};
    };
    place(0, std::span<const io::Frame>(&uniforms_, 1));
    place(1, std::span<const io::Light>(lights_.lights));
    place(2, std::span<const io::ClusterList>(lists_.clusters));
    place(3, std::span<const uint32_t>(lists_.indices));
    place(4, std::span<const io::Spot>(lights_.spots));
    place(5, std::span<const io::DirectionalLight>(lights_.directionals));
    UploadOffsets offsets;
    offsets.rows = upload.add(std::span<const InstanceRows>(draws_.rows));
    if (!draws_.indices.empty()) {
        // lavapipe 22.3 ignores an index buffer's offset in indirect draws: count from 0 instead.
        const auto first = upload.add(std::span<const uint32_t>(draws_.indices)) / sizeof(uint32_t);
        for (auto& command : draws_.commands) {
            command.firstIndex += static_cast<uint32_t>(first);
        }
    }
    offsets.commands = upload.add(std::span<const vk::DrawIndexedIndirectCommand>(draws_.commands));
    upload.commit();
    writeFrameSet(slot, blocks);
    return offsets;
}

void FrameBuilder::writeFrameSet(FrameSlot& slot, const Blocks& blocks) const {
    std::array<vk::DescriptorBufferInfo, Pipelines::kFrameBindings> infos;
    std::array<vk::BufferView, Pipelines::kFrameBindings> views;
    std::array<vk::WriteDescriptorSet, Pipelines::kFrameBindings> writes;
    slot.texel_views.clear();
    for (uint32_t i = 0; i < infos.size(); ++i) {
        // What the frame lacks is described as none.
        const auto& [offset, bytes] = blocks[i];
        infos[i] = bytes > 0 ? vk::DescriptorBufferInfo{slot.upload.buffer(), offset, bytes}
                             : vk::DescriptorBufferInfo{.buffer = {}, .range = VK_WHOLE_SIZE};
        writes[i] = {.dstSet = *slot.frame_set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = Pipelines::kFrameBindingTypes[i],
                     .pBufferInfo = &infos[i]};
        if (Pipelines::kFrameTexelFormats[i] != vk::Format::eUndefined) {
            if (bytes > 0) {
                slot.texel_views.push_back(scene_.device.handle().createBufferView(
                    {.buffer = slot.upload.buffer(),
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

} // namespace froxel::render
