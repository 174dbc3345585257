// A frame's linear picture on the host.
#pragma once

#include "core/linear_image.h"
#include "render/frame/view_targets.h"
#include "render/scene/scene_resources.h"

namespace froxel::render {

// A copy of the radiance target as the last frame left it, samples averaged to pixels. Waits;
// throws vk::SystemError.
[[nodiscard]] LinearImage copyRadiance(SceneResources& scene, const ViewTargets& targets);

} // namespace froxel::render
