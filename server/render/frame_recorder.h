// The frame: which pass follows which, and the barriers between them. Others have only
// blended_recorder.cpp, host_copies.cpp and, between their own passes, effects.
#pragma once

#include "render/frame/frame_context.h"
#include "render/lists/assign_passes.h"

namespace froxel::render {

// Records the slot's pieces from begin to end, none longer than `piece_limit` where work can be
// cut: between two of them other views' frames may be drawn. See FramePieces::begin().
void recordFrame(const FrameContext& frame, Seconds piece_limit, double piece_share);

// Records the assignment of lights on the device, from clearing its counters to copying them to the
// host; lists and indices are ready for shaders.
void recordAssignment(const AssignContext& assign, gpu::Timestamps& timestamps);

} // namespace froxel::render
