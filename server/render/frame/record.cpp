#include "render/frame/record.h"

#include "render/frame/fresh_targets.h"
#include "render/frame/step.h"
#include "render/pipelines/host_copies.h"

namespace froxel::render {

namespace {

// For tests: what a frame that reuses surfaces must not read is overwritten.
void recordSpoil(const FrameContext& frame) {
    if (const auto& words = frame.slot.targets->words; *words.handle) {
        frame.slot.cmd.fillBuffer(*words.handle, 0, VK_WHOLE_SIZE, 0xa5a5a5a5);
        frame.pieces.close(); // the next piece begins behind it
        frame.pieces.add(Seconds(0));
    }
}

} // namespace

void recordFrame(const FrameContext& frame, Seconds piece_limit, double piece_share) {
    FrameSlot& slot = frame.slot;
    frame.pieces.begin(piece_limit, piece_share);
    slot.timestamps.reset();
    slot.host_copy.clear();
    recordFreshTargets(slot);
    if (frame.spoil_scratch) {
        recordSpoil(frame);
    }
    UseTracker tracker;
    for (size_t i = 0; i < frame.steps.size(); ++i) {
        if (frame.steps[i].reused) {
            continue;
        }
        if (const auto wait = tracker.before(frame.plan.steps[i].uses)) {
            barrier(slot.cmd, wait->from, wait->written, wait->to, wait->used);
        }
        frame.steps[i].step->record(frame);
    }
    recordHostRead(slot.cmd);
    frame.pieces.end();
}

} // namespace froxel::render
