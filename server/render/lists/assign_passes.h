// The passes of the light assignment on the device; none records a barrier, their order is in
// frame_recorder.cpp.
#pragma once

#include "render/lists/assign_pipelines.h"
#include "render/lists/gpu_light_lists.h"

namespace froxel::render {

struct AssignContext {
    const vk::raii::CommandBuffer& cmd;
    const AssignPipelines& pipelines;
    const AssignSlot& slot;
};

// Of a small grid: all lists and indices at once.
void recordAssignLines(const AssignContext& assign);
// Of others, in this order.
void recordAssignClear(const AssignContext& assign); // transfer: counters and cursors
void recordAssignBound(const AssignContext& assign); // writes tasks and how many groups they take
void recordAssignCount(const AssignContext& assign); // indirect; writes spans, adds to cursors
void recordAssignSum(const AssignContext& assign);   // reads cursors; writes block sums
void recordAssignPlace(const AssignContext& assign); // writes lists, cursors, queue, outcome
void recordAssignFill(const AssignContext& assign);  // indirect; writes unordered indices
void recordAssignOrder(const AssignContext& assign); // indirect, twice; writes indices
// Transfer: what the host reads of the lists.
void recordAssignCopy(const AssignContext& assign);

} // namespace froxel::render
