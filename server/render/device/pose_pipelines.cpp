#include "render/device/pose_pipelines.h"

#include "core/error.h"
#include "embedded.h"
#include "gpu/pipeline.h"
#include "interface/pose_io.h"
#include "render/pipelines/storage_set.h"

#include <string>

namespace froxel::render {

namespace {

vk::raii::DescriptorSetLayout setLayoutOf(const gpu::Device& device) {
    const uint32_t most = device.limits().maxPerStageDescriptorStorageBuffers;
    if (most < PosePipelines::kBindings) {
        throw StartupError(
            {ErrorCode::kUnsupported, "the scene has skins or morph targets, which take " +
                                          std::to_string(PosePipelines::kBindings) +
                                          " storage buffers in a shader; this device allows " +
                                          std::to_string(most)});
    }
    return storageLayout(device, PosePipelines::kBindings);
}

} // namespace

PosePipelines::PosePipelines(const gpu::Device& device)
    : device_(device), set_layout_(setLayoutOf(device)),
      layout_(gpu::makePipelineLayout(device, {*set_layout_}, sizeof(io::PoseJob))),
      vertices_(gpu::makeComputePipeline(device, shaders::pose_comp(), {}, *layout_, "pose")) {}

vk::Pipeline PosePipelines::flatNormals() {
    const std::lock_guard lock(flat_mutex_);
    if (!*flat_normals_) {
        flat_normals_ =
            gpu::makeComputePipeline(device_, shaders::pose_flat_comp(), {}, *layout_, "pose flat");
    }
    return *flat_normals_;
}

} // namespace froxel::render
