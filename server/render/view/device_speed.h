// How fast a device is, against those on which unit_costs.h was measured.
#pragma once

#include "core/error.h"
#include "render/view/renderer.h"
#include "settings/camera.h"

namespace froxel::render {

// How many times as long it takes for everything.
struct DeviceSpeed {
    double lights = 1;   // and for passes over the picture
    double surfaces = 1; // triangles and their materials
};

// Draws a small picture with lights that reach everything, without, and of surfaces alone, and
// scales the renderer's unit costs by what these took. A camera that sees nothing changes nothing.
// Before the first view; takes some tenths of a second on a CPU device, most of it to compile.
// Errors: kDevice.
Result<DeviceSpeed>
measureSpeed(Renderer& renderer, bool device_is_cpu, const settings::Camera& camera);

} // namespace froxel::render
