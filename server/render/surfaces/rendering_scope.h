// A rendering scope over a frame's targets.
#pragma once

#include "gpu/memory.h"
#include "render/frame/frame_context.h"

#include <array>
#include <span>

namespace froxel::render {

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

// Nothing, which covers nothing of the background.
[[nodiscard]] inline vk::ClearValue nothing() {
    return vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 0.0F});
}

// Open as long as it lives, with the frame's viewport, over a part of the picture.
class Rendering {
  public:
    Rendering(const FrameContext& frame,
              const vk::Rect2D& region,
              std::span<const vk::RenderingAttachmentInfo> colors,
              const vk::RenderingAttachmentInfo* depth)
        : cmd_(frame.slot.cmd) {
        const auto& size = frame.drawn();
        cmd_.beginRendering({.renderArea = region,
                             .layerCount = 1,
                             .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = depth});
        cmd_.setViewport(0, vk::Viewport{0, 0, static_cast<float>(size.width_px),
                                         static_cast<float>(size.height_px), 0, 1});
        cmd_.setScissor(0, region);
    }
    ~Rendering() { cmd_.endRendering(); }
    Rendering(const Rendering&) = delete;
    Rendering& operator=(const Rendering&) = delete;

  private:
    const vk::raii::CommandBuffer& cmd_;
};

} // namespace froxel::render
