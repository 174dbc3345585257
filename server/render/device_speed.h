// How fast a device is, against those on which unit_costs.h was measured.
#pragma once

#include "core/error.h"
#include "render/renderer.h"
#include "view/camera.h"

namespace froxel::render {

// Draws a small picture with lights that reach everything and without, and scales the renderer's
// unit costs by what a (light, pixel) pair took. A camera that sees nothing changes nothing. Before
// the first view; takes some tenths of a second on a CPU device, most of it to compile. Returns the
// scale. Errors: kDevice.
Result<double> measureSpeed(Renderer& renderer, bool device_is_cpu, const view::Camera& camera);

} // namespace froxel::render
