// What surfaces that transmit light are drawn from: their layers and the picture behind each.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/device/device_resources.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/frame/view_targets.h"
#include "render/scene/scene_resources.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace froxel::render {

// StepPlan::way of the steps that find layers and draw them.
inline constexpr uint32_t kLayersByIds = 1U << 0U; // in compute, as solid surfaces are
inline constexpr uint32_t kCullsLayers = 1U << 1U; // and culls their meshlets

// Of a pixel that are drawn, at most.
[[nodiscard]] uint32_t mostLayers(const settings::ViewSettings& settings);
// None: the frame has no such surface. count: how many layers it has at most.
[[nodiscard]] std::optional<StepPlan> planOfTransmission(const PlanInputs& inputs);

// The surfaces that the frame finds and draws by ids; null: by the rasteriser. Throws
// vk::SystemError.
[[nodiscard]] VisibilityScene*
layersById(const SceneResources& scene, const StepInputs& inputs, const StepPlan& plan);

// How many layers, nearest ones first; and levels of the picture behind: 1 where all of them are
// clear, so that nothing is blurred.
struct TransmissionShape {
    uint32_t layer_count = 0;
    uint32_t level_count = 1;
    bool by_ids = false;        // layers are ids of triangles; else depths
    bool nearest_depth = false; // somebody reads the depth of the nearest layers
    bool operator==(const TransmissionShape&) const = default;
};

// As frames draw it.
[[nodiscard]] TransmissionShape
transmissionShape(const SceneResources& scene, const StepInputs& inputs, const StepPlan& plan);

// How far up in levels what is in view looks.
[[nodiscard]] float highestLevel(const SceneResources& scene, const StepInputs& inputs);

struct TransmissionImages {
    gpu::ImageInfo behind;
    gpu::ImageInfo layer_depth; // of each
    uint32_t layer_depth_count = 0;
};
[[nodiscard]] TransmissionImages transmissionImages(const settings::Size& drawn,
                                                    const TransmissionShape& shape);

// Of TransmissionTargets::words; 0: none.
[[nodiscard]] vk::DeviceSize layerWordBytes(const settings::Size& drawn,
                                            const TransmissionShape& shape);

// Of a picture: those of workgroups.
[[nodiscard]] uint32_t layerTileCount(const settings::Size& drawn);
// Of TransmissionTargets::tiles; 0: none.

[[nodiscard]] vk::DeviceSize layerTileBytes(const settings::Size& drawn,
                                            const TransmissionShape& shape);

// What holds all parts, with a corner that is a workgroup's.
[[nodiscard]] vk::Rect2D around(std::span<const vk::Rect2D> parts);

// Shared by all views.
struct TransmissionLayouts {
    explicit TransmissionLayouts(const DeviceResources& shared);

    vk::raii::Sampler sampler; // linear, levels one by one, clamped to the edge
    // A finer level, sampled; a coarser one, stored; tiles of layers.
    vk::raii::DescriptorSetLayout level_layout;
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
    std::vector<gpu::Image> layer_depths; // by ids: of the nearest layers, where it is read
    gpu::Buffer tiles; // by ids: where each layer has pixels (shaders/lib/layer_tiles.glsl)
    gpu::Buffer words; // by ids: depth and id, 64 bits, of each pixel of each layer

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

// Of the frame's slot.
[[nodiscard]] const TransmissionTargets& transmissionTargets(const FrameContext& frame);

// For the rasteriser, a set with the layout of Pipelines::transmissionSetLayout().
void bindTransmission(const FrameContext& frame, vk::DescriptorSet set);

} // namespace froxel::render
