// The passes of the light assignment on the device, in their order.
#pragma once

#include "gpu/timestamps.h"
#include "render/lists/assign_pipelines.h"
#include "render/lists/gpu_light_lists.h"

namespace froxel::render {

struct AssignContext {
    const vk::raii::CommandBuffer& cmd;
    const AssignPipelines& pipelines;
    const AssignSlot& slot;
};

// From clearing its counters to copying them to the host: a small grid's lists all at once, another
// one's by counting, placing and filling them. What reads the lists needs a barrier.
void recordAssignment(const AssignContext& assign, gpu::Timestamps& timestamps);

} // namespace froxel::render
