// The frame: which pass follows which, and the barriers between them. Others have only
// blended_recorder.cpp and, between their own passes, effects.
#pragma once

#include "render/assign_passes.h"
#include "render/frame_context.h"

namespace froxel::render {

// Records the slot's pieces from begin to end, none longer than `piece_limit` where work can be
// cut: between two of them other views' frames may be drawn.
void recordFrame(const FrameContext& frame, Seconds piece_limit);

// Records the assignment of lights on the device, from clearing its counters to copying them to the
// host; lists and indices are ready for shaders.
void recordAssignment(const AssignContext& assign, gpu::Timestamps& timestamps);

// What compute shaders and copies wrote -> the host, once the commands have completed.
void recordHostRead(const vk::raii::CommandBuffer& cmd);

// Copies a target that frames draw into, as it is, to a host buffer, for after a frame.
void recordTargetCopy(const vk::raii::CommandBuffer& cmd,
                      const gpu::Image& target,
                      vk::ImageAspectFlags aspect,
                      const gpu::Buffer& to);

// Likewise which triangles are visible: all ids, then all depths, 4 bytes each.
void recordVisibilityCopy(const vk::raii::CommandBuffer& cmd,
                          const ViewTargets& targets,
                          const gpu::Buffer& to);

} // namespace froxel::render
