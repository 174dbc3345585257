// A rendering scope over a frame's targets.
#pragma once

#include "gpu/memory.h"
#include "render/frame_recorder.h"

#include <span>

namespace froxel::render {

[[nodiscard]] inline vk::Rect2D area(const FrameContext& frame) {
    return {{0, 0}, {frame.slot.targets->size.width_px, frame.slot.targets->size.height_px}};
}

[[nodiscard]] inline vk::RenderingAttachmentInfo
attachment(const gpu::Image& image,
           vk::AttachmentLoadOp load,
           const vk::ClearValue& clear = vk::ClearDepthStencilValue{}) {
    return {.imageView = *image.view,
            .imageLayout = vk::ImageLayout::eGeneral,
            .loadOp = load,
            .storeOp = vk::AttachmentStoreOp::eStore,
            .clearValue = clear};
}

// Reversed-Z: nothing is as far as 0.
[[nodiscard]] inline vk::ClearValue farDepth() {
    return vk::ClearDepthStencilValue{.depth = 0.0F, .stencil = 0};
}

// Open as long as it lives, with the frame's viewport.
class Rendering {
  public:
    Rendering(const FrameContext& frame,
              std::span<const vk::RenderingAttachmentInfo> colors,
              const vk::RenderingAttachmentInfo* depth)
        : cmd_(frame.slot.cmd) {
        const auto rect = area(frame);
        cmd_.beginRendering({.renderArea = rect,
                             .layerCount = 1,
                             .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = depth});
        cmd_.setViewport(0, vk::Viewport{0, 0, static_cast<float>(rect.extent.width),
                                         static_cast<float>(rect.extent.height), 0, 1});
        cmd_.setScissor(0, rect);
    }
    ~Rendering() { cmd_.endRendering(); }
    Rendering(const Rendering&) = delete;
    Rendering& operator=(const Rendering&) = delete;

  private:
    const vk::raii::CommandBuffer& cmd_;
};

} // namespace froxel::render
