// The frame: which pass follows which, and the barriers between them. The only file that has any.
#pragma once

#include "render/draw_list.h"
#include "render/frame_plan.h"
#include "render/frame_slot.h"
#include "render/scene_resources.h"

namespace froxel::render {

// Offsets into the slot's upload buffer.
struct UploadOffsets {
    vk::DeviceSize rows = 0;
    vk::DeviceSize commands = 0;
};

struct FrameContext {
    SceneResources& scene;
    FrameSlot& slot;
    const FramePlan& plan;
    const DrawList& draws;
    UploadOffsets offsets;
    glm::vec3 background{0};
};

// Records slot.cmd from begin to end.
void recordFrame(const FrameContext& frame);

// Copies the radiance target, RGBA fp32, to a host buffer, for after a frame.
void recordRadianceCopy(const vk::raii::CommandBuffer& cmd,
                        const ViewTargets& targets,
                        const gpu::Buffer& to);

} // namespace froxel::render
