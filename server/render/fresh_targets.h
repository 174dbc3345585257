// Images that no frame has used yet.
#pragma once

#include "render/frame_slot.h"

namespace froxel::render {

// Moves those of the slot into the GENERAL layout, in which they stay.
void recordFreshTargets(FrameSlot& slot);

} // namespace froxel::render
