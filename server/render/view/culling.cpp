#include "render/view/culling.h"

#include "render/frame/visibility_instances.h"
#include "render/pipelines/gbuffer_layout.h"

#include <chrono>
#include <span>

namespace froxel::render {

namespace {

bool byIds(GeometryPath path) {
    return path == GeometryPath::kVisibility || path == GeometryPath::kComputeRaster;
}

bool choosesIds(const FrameInputs& inputs,
                const SceneResources& scene,
                const ScenePose& pose,
                Detail detail) {
    using settings::LightingStage;
    const auto& traits = scene.shared.device.traits();
    if (settings::showsFragments(inputs.settings.debug.view)) {
        return false; // the rasteriser's fragments
    }
    const bool pays =
        inputs.geometry == GeometryPath::kAuto && !traits.is_cpu && traits.descriptor_indexing;
    const auto stage = inputs.settings.lighting;
    // Only the rasteriser writes one, and only it draws layers where lights are added up there.
    const bool second_target =
        extraFormat(inputs.settings.gbuffer,
                    storesSpecular(inputs.settings, pose.materialSet()->needs.specular)) !=
        vk::Format::eUndefined;
    const bool wanted =
        isForward(inputs.settings.renderer)
            ? stage == LightingStage::kCompute || (stage == LightingStage::kAuto && pays)
            : !second_target && (byIds(inputs.geometry) || pays) &&
                  (stage != LightingStage::kFragment ||
                   !drawsLayers(inputs.settings, pose.materialSet()->needs.layers));
    return wanted && pose.materialSet()->visibilityUnusable(detail).empty() &&
           pose.windsAsAtStart() && !pose.materialSet()->visibility(detail).groups.empty();
}

bool choosesComputeRaster(const FrameInputs& inputs,
                          const SceneResources& scene,
                          const ScenePose& pose,
                          Detail detail) {
    const bool wanted =
        inputs.geometry == GeometryPath::kComputeRaster ||
        (inputs.geometry == GeometryPath::kAuto && !scene.shared.device.traits().is_cpu);
    return wanted && pose.materialSet()->visibility(detail).compute_unusable.empty();
}

} // namespace

// On a CPU device culling and light assignment, which do not need each other, go side by side:
// 7 becomes 5 ms on two cores (Sponza). Elsewhere the host has too little to do for a thread.
void Culling::start(const FrameInputs& inputs,
                    const ScenePose& pose,
                    const ViewProjection& projection) {
    const Detail detail = scene_.detailOf(inputs.settings.geometry_error_px);
    geometry_ = !choosesIds(inputs, scene_, pose, detail)            ? SolidGeometry::kRaster
                : choosesComputeRaster(inputs, scene_, pose, detail) ? SolidGeometry::kComputeIds
                                                                     : SolidGeometry::kIds;
    culls_ = {.camera = inputs.settings.camera,
              .size = inputs.settings.size,
              .geometry_error_px = detail == Detail::kExact ? 0 : inputs.settings.geometry_error_px,
              .pose = pose.number(),
              .by_ids = geometry_ != SolidGeometry::kRaster,
              .order = inputs.settings.transparency == settings::Transparency::kSorted
                           ? TransparentOrder::kByDistance
                           : TransparentOrder::kOfTheScene};
    if (culled_ == culls_) {
        return; // the draw list is a function of them
    }
    culled_.reset();
    ++number_;
    const bool is_cpu = scene_.shared.device.traits().is_cpu;
    culling_ = std::async(is_cpu ? std::launch::async : std::launch::deferred,
                          [this, &pose, &projection] { build(pose, projection); });
}

void Culling::build(const ScenePose& pose, const ViewProjection& projection) {
    const auto& [camera, size, geometry_error_px, number, by_ids, order] = culls_;
    buildDrawList(scene_, pose, camera, size, projection, geometry_error_px,
                  scene_.shared.device.traits().is_cpu, !by_ids, order, draws_);
    if (by_ids) {
        placeInstances(pose.instances(), camera, draws_.rows, instances_);
        orderMeshlets(pose.materialSet()->visibility(scene_.detailOf(geometry_error_px)),
                      scene_.meshlets, draws_.rows, meshlet_order_);
    }
}

void Culling::settle() const {
    if (culling_.valid() &&
        culling_.wait_for(std::chrono::seconds(0)) != std::future_status::deferred) {
        culling_.wait();
    }
}

void Culling::finish() {
    if (culling_.valid()) {
        culling_.get();
        culled_ = culls_;
    }
}

void Culling::gather(FrameUpload& upload, UploadOffsets& offsets) {
    offsets.rows = upload.add(std::span<const InstanceRows>(draws_.rows));
    std::span<const vk::DrawIndexedIndirectCommand> commands = draws_.commands;
    if (!draws_.indices.empty()) {
        // lavapipe 22.3 ignores an index buffer's offset in indirect draws: count from 0 instead.
        const auto first = upload.add(std::span<const uint32_t>(draws_.indices)) / sizeof(uint32_t);
        placed_commands_ = draws_.commands;
        for (auto& command : placed_commands_) {
            command.firstIndex += static_cast<uint32_t>(first);
        }
        commands = placed_commands_;
    }
    if (geometry_ != SolidGeometry::kRaster) {
        offsets.instances = upload.add(std::span<const io::InstanceView>(instances_));
        offsets.meshlet_order = upload.add(std::span<const uint32_t>(meshlet_order_));
    }
    offsets.commands = upload.add(commands);
}

} // namespace froxel::render
