#include "render/fresh_targets.h"

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
                                .subresourceRange = {aspect, 0, 1, 0, 1}});
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
    if (slot.blend && std::exchange(slot.blend->fresh, false)) {
        add(slot.blend->sums, vk::ImageAspectFlagBits::eColor);
        add(slot.blend->weights, vk::ImageAspectFlagBits::eColor);
        add(slot.blend->layer_depth, vk::ImageAspectFlagBits::eDepth);
        for (const auto& keys : slot.blend->layer_keys) {
            add(keys, vk::ImageAspectFlagBits::eColor);
        }
    }
    slot.effect_targets.forEach([&](EffectTargets& effect) {
        if (std::exchange(effect.fresh, false)) {
            effect.forEachImage(add);
        }
    });
    if (!barriers.empty()) {
        slot.cmd.pipelineBarrier2(
            {.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size()),
             .pImageMemoryBarriers = barriers.data()});
    }
}

void markFresh(FrameSlot& slot) {
    const auto mark = [](const auto& targets) {
        if (targets) {
            targets->fresh = true;
        }
    };
    mark(slot.targets);
    mark(slot.blend);
    mark(slot.posed);
    slot.effect_targets.forEach([](EffectTargets& effect) { effect.fresh = true; });
    forgetDrawn(slot);
}

void forgetDrawn(const FrameSlot& slot) {
    if (slot.targets) {
        slot.targets->surfaces.reset();
    }
    if (slot.posed) {
        slot.posed->pose.reset();
    }
    slot.effect_targets.forEach([](EffectTargets& effect) { effect.forgetDrawn(); });
}

} // namespace froxel::render
