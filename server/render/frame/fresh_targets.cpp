#include "render/frame/fresh_targets.h"

#include <utility>
#include <vector>

namespace froxel::render {

void recordFreshTargets(FrameSlot& slot) {
    std::vector<vk::ImageMemoryBarrier2> barriers;
    const auto add = [&](const gpu::Image& image, vk::ImageAspectFlags aspect) {
        if (*image.handle) {
            // After whatever still writes them, of frames before one whose commands did not run.
            barriers.push_back({.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                .dstAccessMask = vk::AccessFlagBits2::eMemoryRead |
                                                 vk::AccessFlagBits2::eMemoryWrite,
                                .oldLayout = vk::ImageLayout::eUndefined,
                                .newLayout = vk::ImageLayout::eGeneral,
                                .image = *image.handle,
                                .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}});
        }
    };
    ViewTargets& targets = *slot.targets;
    if (std::exchange(targets.fresh, false)) {
        add(targets.depth, vk::ImageAspectFlagBits::eDepth);
        add(targets.gbuffer, vk::ImageAspectFlagBits::eColor);
        add(targets.gbuffer_extra, vk::ImageAspectFlagBits::eColor);
        add(targets.ids, vk::ImageAspectFlagBits::eColor);
        add(targets.compute_depth, vk::ImageAspectFlagBits::eColor);
        add(targets.radiance, vk::ImageAspectFlagBits::eColor);
    }
    slot.step_targets.forEach([&](StepTargets& of_step) {
        if (std::exchange(of_step.fresh, false)) {
            of_step.begin();
            of_step.forEachImage(add);
        }
    });
    if (!barriers.empty()) {
        slot.cmd.pipelineBarrier2(
            {.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size()),
             .pImageMemoryBarriers = barriers.data()});
    }
}

void markFresh(FrameSlot& slot) {
    if (slot.targets) {
        slot.targets->fresh = true;
    }
    slot.step_targets.forEach([](StepTargets& of_step) { of_step.fresh = true; });
    forgetDrawn(slot);
}

void forgetDrawn(const FrameSlot& slot) {
    if (slot.targets) {
        slot.targets->surfaces.reset();
    }
    slot.step_targets.forEach([](StepTargets& of_step) { of_step.forgetDrawn(); });
}

} // namespace froxel::render
