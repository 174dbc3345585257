#include "render/lists/assign_passes.h"

#include "core/ceil_divide.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/pass_names.h"

#include <algorithm>
#include <cstddef>

namespace froxel::render {

namespace {

void bind(const AssignContext& assign, AssignPass pass) {
    assign.cmd.bindPipeline(vk::PipelineBindPoint::eCompute, assign.pipelines.pipeline(pass));
    assign.cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, assign.pipelines.layout(), 0,
                                  assign.slot.set(), {});
}

void dispatch(const AssignContext& assign, AssignPass pass, uint32_t group_count) {
    bind(assign, pass);
    assign.cmd.dispatch(std::max(group_count, 1U), 1, 1);
}

// arguments: an io::AssignDispatch within the counters.
void dispatchIndirect(const AssignContext& assign, AssignPass pass, size_t arguments) {
    bind(assign, pass);
    assign.cmd.dispatchIndirect(*assign.slot.buffers().totals.handle, arguments);
}

uint32_t scanGroups(const AssignContext& assign) {
    return ceilDivide(assign.slot.frame().cluster_count, io::kAssignScanBlock);
}

void clearLists(const AssignContext& assign) {
    const ListBuffers& buffers = assign.slot.buffers();
    io::AssignTotals totals{};
    totals.tasks = totals.short_lists = totals.long_lists = {.x = 0, .y = 1, .z = 1};
    assign.cmd.updateBuffer<io::AssignTotals>(*buffers.totals.handle, 0, totals);
    if (assign.slot.pricedTiles() > 0) {
        assign.cmd.fillBuffer(*buffers.totals.handle, sizeof(io::AssignTotals),
                              assign.slot.pricedTiles() * sizeof(uint32_t), 0);
    }
    assign.cmd.fillBuffer(*buffers.cursors.handle, 0,
                          assign.slot.frame().cluster_count * sizeof(uint32_t), 0);
}

void recordLines(const AssignContext& assign) {
    dispatch(assign, AssignPass::kLines, assign.slot.frame().grid_y * assign.slot.frame().grid_z);
}

void recordBound(const AssignContext& assign) {
    dispatch(assign, AssignPass::kBound,
             ceilDivide(assign.slot.frame().light_count, io::kAssignGroup));
}

void recordCount(const AssignContext& assign) {
    dispatchIndirect(assign, AssignPass::kCount, offsetof(io::AssignTotals, tasks));
}

void recordSum(const AssignContext& assign) {
    dispatch(assign, AssignPass::kSum, scanGroups(assign));
}

void recordPlace(const AssignContext& assign) {
    dispatch(assign, AssignPass::kPlace, scanGroups(assign));
}

void recordFill(const AssignContext& assign) {
    dispatchIndirect(assign, AssignPass::kFill, offsetof(io::AssignTotals, tasks));
}

void recordOrder(const AssignContext& assign) {
    dispatchIndirect(assign, AssignPass::kOrderShort, offsetof(io::AssignTotals, short_lists));
    dispatchIndirect(assign, AssignPass::kOrderLong, offsetof(io::AssignTotals, long_lists));
}

void copyForHost(const AssignContext& assign) {
    const AssignSlot& slot = assign.slot;
    const auto& from = slot.inLines() ? slot.buffers().lists : slot.buffers().totals;
    const uint64_t bytes = slot.inLines()
                               ? slot.frame().cluster_count * sizeof(io::ClusterList)
                               : sizeof(io::AssignTotals) + slot.pricedTiles() * sizeof(uint32_t);
    assign.cmd.copyBuffer(*from.handle, slot.readback(), vk::BufferCopy{.size = bytes});
}

} // namespace

void recordAssignment(const AssignContext& assign, gpu::Timestamps& timestamps) {
    const auto& cmd = assign.cmd;
    const auto finish = [&] {
        // lists, indices, counters -> copy
        copyAfterCompute(cmd);
        copyForHost(assign);
    };
    if (assign.slot.inLines()) {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignLines);
        recordLines(assign);
        finish();
        return;
    }
    {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignCount);
        clearLists(assign);
        computeAfterTransfer(cmd);
        recordBound(assign);
        nextIndirectPass(cmd);
        recordCount(assign);
        nextIndirectPass(cmd);
    }
    {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignScan);
        recordSum(assign);
        nextIndirectPass(cmd);
        recordPlace(assign);
        nextIndirectPass(cmd);
    }
    {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignFill);
        recordFill(assign);
        nextIndirectPass(cmd);
    }
    const gpu::PassScope scope(timestamps, cmd, pass::kAssignOrder);
    recordOrder(assign);
    finish();
}

} // namespace froxel::render
