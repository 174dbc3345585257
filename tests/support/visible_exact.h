// The exactness contract where surfaces come from the ids of triangles.
#pragma once

#include "support/draw.h"

namespace froxel::test {

// Draws `inputs` by lists, whatever their renderer and stage: forward_plus in compute is naive, the
// deferred picture by lists is by all lights, and culling changes neither, bit for bit. Returns the
// deferred picture.
Picture expectVisibleExact(render::ViewRenderer& view, const render::FrameInputs& inputs);

} // namespace froxel::test
