// Compute passes over the picture, which read and write the view's targets by its screen set.
#pragma once

#include "render/frame/frame_context.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/variant_cache.h"

#include <string_view>

namespace froxel::render {

// The variants of one, for all views: DeviceResources::stored() holds a type derived from it.
class ScreenPipelines {
  public:
    using Code = gpu::Spirv (*)(const VariantKey& key);

    ScreenPipelines(DeviceResources& shared, Code code, std::string_view name);
    ScreenPipelines(const ScreenPipelines&) = delete;
    ScreenPipelines& operator=(const ScreenPipelines&) = delete;

    // May throw VariantsMissing.
    [[nodiscard]] vk::Pipeline find(const VariantKey& key);

  private:
    const gpu::Device& device_;
    vk::PipelineLayout layout_;
    Code code_;
    std::string_view name_;
    VariantCache<VariantKey> made_;
};

// The slot's frame and screen sets.
void bindScreenSets(const FrameContext& frame, vk::PipelineBindPoint point);
// And the pipeline.
void bindScreen(const FrameContext& frame, vk::PipelineBindPoint point, vk::Pipeline pipeline);

// One pass over a part of the picture, as a variant of T, which is a ScreenPipelines.
template <class T>
void recordScreenPass(const FrameContext& frame,
                      const char* label,
                      const VariantKey& key,
                      const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, label);
    bindScreen(frame, vk::PipelineBindPoint::eCompute, frame.scene.shared.stored<T>().find(key));
    dispatchOver(frame.slot.cmd, region);
}

} // namespace froxel::render
