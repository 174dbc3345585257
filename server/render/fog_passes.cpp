#include "render/fog_passes.h"

#include "render/screen_groups.h"

#include <array>

namespace froxel::render {

namespace {

void bind(const FrameContext& frame,
          FogShader shader,
          const VariantKey& key,
          vk::PipelineLayout layout,
          vk::DescriptorSet second) {
    const auto& cmd = frame.slot.cmd;
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, frame.scene.fog().pipeline(shader, key));
    const std::array sets = {*frame.slot.frame_set, second};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, layout, 0, sets, {});
}

} // namespace

void recordFogScatter(const FrameContext& frame, const vk::Rect2D& nodes) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, "fog_scatter");
    const uint32_t noise = frame.plan.fog_noise ? io::kOutputFogNoise : 0U;
    bind(frame, FogShader::kScatter,
         {0, frame.plan.fog_light_flags & ~io::kLightDirectional, noise},
         frame.scene.fog().volumeLayout(), frame.slot.fog->set());
    dispatchOver(frame.slot.cmd, nodes, frame.fog->slice_count);
}

void recordFogIntegrate(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, "fog_integrate");
    bind(frame, FogShader::kIntegrate, {}, frame.scene.fog().volumeLayout(), frame.slot.fog->set());
    frame.slot.cmd.dispatch(screenGroups(frame.fog->node_count_x),
                            screenGroups(frame.fog->node_count_y), 1);
}

void recordFogApply(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, "fog");
    bind(frame, FogShader::kApply,
         {0, frame.plan.fog_light_flags & io::kLightDirectional, frame.plan.fog_output_flags},
         frame.scene.pipelines.screenPipelineLayout(), *frame.slot.screen_set);
    dispatchOver(frame.slot.cmd, region);
}

} // namespace froxel::render
