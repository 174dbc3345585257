// What blended surfaces are drawn into before they come over the picture, where they are not drawn
// into it at once.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/frame/step_targets.h"
#include "render/frame/view_targets.h"
#include "render/pipelines/pipelines.h"

#include <array>
#include <memory>
#include <vector>

namespace froxel::render {

// In the order of BlendTargets' members.
struct BlendImage {
    const char* name;
    gpu::ImageInfo info;
};
[[nodiscard]] std::vector<BlendImage> blendImages(settings::Transparency transparency,
                                                  const settings::Size& drawn);

// One view's, for one kind of transparency. Frames in flight keep theirs alive.
class BlendTargets final : public StepTargets {
  public:
    // Throws vk::OutOfDeviceMemoryError.
    BlendTargets(const gpu::Device& device,
                 const Pipelines& pipelines,
                 settings::Transparency transparency,
                 std::shared_ptr<const ViewTargets> view);

    // Whether frames with this kind and these targets, as they are now, can use them.
    [[nodiscard]] bool fits(settings::Transparency transparency, const ViewTargets& view) const;
    // For selecting a layer; selectedSet() names what that selected.
    [[nodiscard]] vk::DescriptorSet selectSet(uint32_t layer) const {
        return selectedSet(layer + 1); // of the layer before
    }
    [[nodiscard]] vk::DescriptorSet selectedSet(uint32_t layer) const { return *sets_[layer % 2]; }
    [[nodiscard]] vk::DescriptorSet resolveSet() const { return *sets_.back(); }

    void forEachImage(const Visit& visit) const override;

    gpu::MemoryArena arena;
    gpu::Image sums;                      // premultiplied radiance and alpha, or what is left of it
    gpu::Image weights;                   // weighted; else null handle
    gpu::Image layer_depth;               // peeled; else null handle
    std::array<gpu::Image, 2> layer_keys; // of even and odd layers, likewise

  private:
    void writeSets(const gpu::Device& device, const Pipelines& pipelines);

    settings::Transparency transparency_;
    std::shared_ptr<const ViewTargets> view_; // whose depth the sets name
    vk::ImageView solid_depth_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> sets_; // even layers, odd layers, resolve
};

} // namespace froxel::render
