// Images that no frame has used yet.
#pragma once

#include "render/frame/frame_slot.h"

namespace froxel::render {

// Moves those of the slot into the GENERAL layout, in which they stay.
void recordFreshTargets(FrameSlot& slot);

// The commands recorded last will not run: those that they were to move still have to be, and the
// view's own vertices to be copied. What the others hold is of no use to the next frame.
void markFresh(FrameSlot& slot);

// Nobody knows how much of the slot's frame was drawn: the next frames keep nothing of it.
void forgetDrawn(const FrameSlot& slot);

} // namespace froxel::render
