// Bloom's pipelines, pictures and passes; they exist for views that ask for it.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/bloom_plan.h"
#include "render/variant_cache.h"
#include "render/view_targets.h"

#include <memory>
#include <utility>
#include <vector>

namespace froxel::render {

// Shared by every view; a pipeline is made when first needed.
class BloomPipelines {
  public:
    BloomPipelines(const gpu::Device& device, const gpu::Timeline& timeline, VariantMaker& maker);

    [[nodiscard]] vk::Pipeline pipeline(BloomShader shader, uint32_t flags);
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    VariantCache<std::pair<BloomShader, uint32_t>> made_;
};

// One of bloom's own pictures.
[[nodiscard]] gpu::ImageInfo bloomImage(const view::Size& size);

// One view's pictures for one plan. Frames in flight keep theirs alive.
class BloomTargets {
  public:
    // Throws vk::OutOfDeviceMemoryError.
    BloomTargets(const gpu::Device& device,
                 const BloomPipelines& pipelines,
                 const BloomPlan& plan,
                 std::shared_ptr<const ViewTargets> view);

    // Whether frames of this plan and view can use them.
    [[nodiscard]] bool fits(const BloomPlan& plan, const ViewTargets& view) const;
    // Of a step, by its place in the plan.
    [[nodiscard]] vk::DescriptorSet set(size_t step) const { return *sets_[step]; }
    [[nodiscard]] const std::vector<gpu::Image>& images() const { return images_; }

    bool fresh = true; // the images still await their first transition

  private:
    std::shared_ptr<const ViewTargets> view_; // whose picture the sets name
    std::vector<view::Size> sizes_;
    std::vector<BloomWire> wires_;
    gpu::MemoryArena arena_;
    std::vector<gpu::Image> images_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> sets_;
};

// One step; barriers lie between them.
void recordBloomStep(const vk::raii::CommandBuffer& cmd,
                     BloomPipelines& pipelines,
                     const BloomTargets& targets,
                     const BloomPlan& plan,
                     size_t step,
                     const vk::Rect2D& region);

// `kept` where it fits the plan and the view, else others. Throws vk::OutOfDeviceMemoryError.
[[nodiscard]] std::shared_ptr<BloomTargets>
bloomTargetsFor(const gpu::Device& device,
                const BloomPipelines& pipelines,
                const BloomPlan& plan,
                const std::shared_ptr<ViewTargets>& view,
                std::shared_ptr<BloomTargets> kept);

} // namespace froxel::render
