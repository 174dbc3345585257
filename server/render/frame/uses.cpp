#include "render/frame/uses.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;

constexpr vk::AccessFlags2 kWrites = Access::eShaderStorageWrite | Access::eColorAttachmentWrite |
                                     Access::eDepthStencilAttachmentWrite | Access::eTransferWrite;

template <class Flags>
bool contains(Flags all, Flags some) {
    return (all & some) == some;
}

} // namespace

bool writes(const Use& use) {
    return static_cast<bool>(use.access & kWrites);
}

std::optional<Dependency> UseTracker::before(std::span<const Use> uses) {
    Dependency needed;
    for (const Use& use : uses) {
        State& state = states_[static_cast<size_t>(use.what)];
        const bool sees = std::ranges::any_of(state.seen, [&use](const Use& seen) {
            return contains(seen.stages, use.stages) && contains(seen.access, use.access);
        });
        const bool after_write = static_cast<bool>(state.write_stages) && !sees;
        const bool after_read = writes(use) && static_cast<bool>(state.read_stages);
        if (after_write || after_read) {
            needed.from |= (after_write ? state.write_stages : vk::PipelineStageFlags2{}) |
                           (after_read ? state.read_stages : vk::PipelineStageFlags2{});
            needed.written |= after_write ? state.write_access : vk::AccessFlags2{};
            needed.to |= use.stages;
            needed.used |= use.access;
        }
    }
    for (const Use& use : uses) {
        // All that the step does to the resource, as one.
        Use all{use.what, {}, {}};
        for (const Use& other : uses) {
            if (other.what == use.what) {
                all.stages |= other.stages;
                all.access |= other.access;
            }
        }
        State& state = states_[static_cast<size_t>(use.what)];
        if (writes(all)) {
            state = {.write_stages = all.stages,
                     .write_access = all.access & kWrites,
                     .read_stages = {},
                     .seen = {}};
        } else {
            state.read_stages |= use.stages;
            state.seen.push_back(use);
        }
    }
    return needed.to ? std::optional(needed) : std::nullopt;
}

} // namespace froxel::render
