// What surfaces that transmit light are drawn from: the depth of their layers, and the picture
// behind each.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/device/device_resources.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/frame/view_targets.h"
#include "render/scene/scene_resources.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace froxel::render {

// How many layers, nearest ones first; and levels of the picture behind: 1 where all of them are
// clear, so that nothing is blurred.
struct TransmissionShape {
    uint32_t layer_count = 0;
    uint32_t level_count = 1;
    bool operator==(const TransmissionShape&) const = default;
};

// As frames draw it. most_layers: at most so many.
[[nodiscard]] TransmissionShape
transmissionShape(const SceneResources& scene, const StepInputs& inputs, uint32_t most_layers);

// How far up in levels what is in view looks.
[[nodiscard]] float highestLevel(const SceneResources& scene, const StepInputs& inputs);

struct TransmissionImages {
    gpu::ImageInfo behind;
    gpu::ImageInfo layer_depth; // of each
};
[[nodiscard]] TransmissionImages transmissionImages(const settings::Size& drawn,
                                                    const TransmissionShape& shape);

// Shared by all views.
struct TransmissionLayouts {
    explicit TransmissionLayouts(const DeviceResources& shared);

    vk::raii::Sampler sampler;                  // linear, levels one by one, clamped to the edge
    vk::raii::DescriptorSetLayout level_layout; // a finer level, sampled; a coarser one, stored
};

// One view's. Frames in flight keep theirs alive.
class TransmissionTargets final : public StepTargets {
  public:
    // Throws vk::OutOfDeviceMemoryError.
    TransmissionTargets(DeviceResources& shared,
                        const TransmissionShape& shape,
                        std::shared_ptr<const ViewTargets> view);

    // Whether frames of this shape and with these targets, as they are now, can use them.
    [[nodiscard]] bool fits(const TransmissionShape& shape, const ViewTargets& view) const;
    // For finding a layer's depth: solid depth and the layer before.
    [[nodiscard]] vk::DescriptorSet depthSet(uint32_t layer) const { return *depth_sets_[layer]; }
    // For drawing it: solid depth and the picture behind.
    [[nodiscard]] vk::DescriptorSet behindSet() const { return *depth_sets_.back(); }
    // For filling a level of the picture behind; 0: from the picture.
    [[nodiscard]] vk::DescriptorSet levelSet(uint32_t level) const { return *level_sets_[level]; }
    [[nodiscard]] vk::Extent2D levelExtent(uint32_t level) const;

    void forEachImage(const Visit& visit) const override;

    gpu::MemoryArena arena;
    gpu::Image behind; // radiance, with levels; alpha: how much of the background is covered
    std::vector<gpu::Image> layer_depths;

  private:
    void makeViews(const gpu::Device& device);
    void writeSets(DeviceResources& shared);

    TransmissionShape shape_;
    std::shared_ptr<const ViewTargets> view_; // whose depth the sets name
    vk::ImageView solid_depth_;
    std::vector<vk::raii::ImageView> level_views_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> depth_sets_; // of each layer, and behindSet()
    std::vector<vk::raii::DescriptorSet> level_sets_;
};

} // namespace froxel::render
