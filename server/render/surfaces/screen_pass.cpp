#include "render/surfaces/screen_pass.h"

#include "gpu/pipeline.h"

#include <array>

namespace froxel::render {

ScreenPipelines::ScreenPipelines(DeviceResources& shared, Code code, std::string_view name)
    : device_(shared.device), layout_(shared.pipelines.screenPipelineLayout()), code_(code),
      name_(name), made_(shared.timeline, shared.variants, Pipelines::kKeptScreen) {
    shared.listVariants([this](std::vector<Pipelines::Made>& all) {
        made_.forEachKey([&](const VariantKey& key) { all.push_back({name_, key}); });
    });
}

vk::Pipeline ScreenPipelines::find(const VariantKey& key) {
    return *made_.findOrMake(key, [=, this] {
        return gpu::makeComputePipeline(device_, code_(key), specConstants(key, device_.traits()),
                                        layout_, name_);
    });
}

void bindScreenSets(const FrameContext& frame, vk::PipelineBindPoint point) {
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set};
    frame.slot.cmd.bindDescriptorSets(point, frame.scene.shared.pipelines.screenPipelineLayout(), 0,
                                      sets, {});
}

void bindScreen(const FrameContext& frame, vk::PipelineBindPoint point, vk::Pipeline pipeline) {
    frame.slot.cmd.bindPipeline(point, pipeline);
    bindScreenSets(frame, point);
}

} // namespace froxel::render
