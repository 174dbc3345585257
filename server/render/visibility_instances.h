// Instances as one frame's camera sees them, for culling and shading on the device.
#pragma once

#include "interface/visibility_io.h"
#include "render/draw_list.h"

#include <span>
#include <vector>

namespace froxel::render {

// rows: DrawList::rows of the same camera. Pure.
void placeInstances(const SceneResources& scene,
                    const view::Camera& camera,
                    std::span<const InstanceRows> rows,
                    std::vector<io::InstanceView>& out);

} // namespace froxel::render
