// What can't be drawn, before anything is tried.
#pragma once

#include "core/error.h"
#include "render/renderer.h"

namespace froxel::render {

// Whether this device and these settings can give what is asked for. Errors: kUnsupported, saying
// what lacks and what would do.
[[nodiscard]] Result<void> canDraw(const FrameInputs& inputs, SceneResources& scene);

// kCapacity: targets of these settings did not fit the device's memory.
[[nodiscard]] Error noMemoryFor(const view::ViewSettings& settings);

} // namespace froxel::render
