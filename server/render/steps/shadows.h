// Shadow maps: depths as lights see them, in one atlas, where whatever is lit looks them up. Drawn
// by the depth prepass's own pipelines.
#pragma once

#include "render/frame/step_plan.h"

#include <cstdint>
#include <vector>

namespace froxel::render {

class ViewSteps;

// Of StepPlan::way: the frame draws maps. Else it keeps the atlas for when a light with maps
// comes back into view.
inline constexpr uint32_t kShadowsDrawn = 1U << 0U;

// A view's shadow maps on the host, for tests.
struct ShadowAtlas {
    uint32_t size_px = 0;      // of a tile
    uint32_t width_px = 0;     // of the atlas
    std::vector<float> depths; // [height][width]: the reach's thousandth over the distance; 0: none
    std::vector<uint32_t> shadow_of_light; // of each local light: into first_tiles; io::kNoShadow
    std::vector<uint32_t> first_tiles;     // of each light with maps
};

// As its last frame with maps left them. Waits; throws vk::SystemError.
[[nodiscard]] ShadowAtlas copyShadows(const ViewSteps& steps);

} // namespace froxel::render
