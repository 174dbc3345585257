// From a frame's plan to its commands.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

// Records the slot's pieces from begin to end, step after step with the barriers that follow from
// their uses, none longer than `piece_limit` where work can be cut: between two pieces other views'
// frames may be drawn. See FramePieces::begin(). May throw VariantsMissing.
void recordFrame(const FrameContext& frame, Seconds piece_limit, double piece_share);

} // namespace froxel::render
