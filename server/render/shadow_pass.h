// The shadow atlas of a view and the pass that draws into it; both exist for views that ask for
// shadows. Maps are drawn by the depth prepass's own pipelines.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/pipelines.h"
#include "render/shadow_atlas.h"
#include "view/settings.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace froxel::render {

struct FrameContext;
struct ShadowFrame;
class SceneResources;

// The atlas that `light_count` point lights have, or as many as the settings allow.
[[nodiscard]] gpu::ImageInfo shadowImage(const view::Shadows& settings, uint32_t light_count);

// Tiles of shadows.size_px in rows of io::kShadowColumns. Frames in flight keep theirs alive.
struct ShadowTargets {
    // Throws vk::OutOfDeviceMemoryError.
    ShadowTargets(const gpu::Device& device, const view::Shadows& settings, uint32_t light_count);

    [[nodiscard]] bool fits(const view::Shadows& settings, uint32_t light_count) const;

    uint32_t size_px;
    uint32_t tile_count;
    gpu::MemoryArena arena;
    gpu::Image atlas;  // ends in the GENERAL layout, where it stays
    bool fresh = true; // still awaits its first transition
};

// A view's targets for its next frame, out of those of its last (null: none). Where the frame draws
// no map they stay as they are while the settings ask for shadows: a light may come back into view.
[[nodiscard]] std::shared_ptr<ShadowTargets> shadowTargetsFor(const gpu::Device& device,
                                                              const view::Shadows& settings,
                                                              uint32_t light_count,
                                                              bool drawn,
                                                              std::shared_ptr<ShadowTargets> last);

// How shaders see an atlas; null: none.
[[nodiscard]] vk::DescriptorImageInfo atlasInfo(const ShadowTargets* targets);

// One a frame slot: what the map's vertex shader reads, as a frame set of its own.
class ShadowSlot {
  public:
    ShadowSlot(const gpu::Device& device, const Pipelines& pipelines);

    // io::Frame at an offset of a buffer; the slot is not in flight.
    void write(vk::Buffer upload, vk::DeviceSize uniforms);
    [[nodiscard]] vk::DescriptorSet set() const { return *set_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
};

// A copy of the atlas as the last frame left it. Waits; throws vk::SystemError.
[[nodiscard]] ShadowAtlas
copyShadows(SceneResources& scene, const ShadowTargets& targets, const ShadowFrame& frame);

// Clears and draws the faces of frame.shadows. Barriers are frame_recorder's.
void recordShadows(const FrameContext& frame);

} // namespace froxel::render
