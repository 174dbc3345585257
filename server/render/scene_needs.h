// What a scene has, and so which shader features, vertex streams and passes it needs.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace froxel::render {

struct SceneNeeds {
    std::vector<uint32_t> material_flags; // io::kMaterial* of each material
    bool wide_gbuffer = false;            // metalness, occlusion, emission or unlit somewhere
    bool masked = false;
    bool blended = false;
    bool spots = false;
    bool directional = false;
};

[[nodiscard]] SceneNeeds findNeeds(const scene::Scene& scene);

// One line each: a pass or feature, whether this scene needs it and why.
[[nodiscard]] std::vector<std::string> explainNeeds(const scene::Scene& scene);

} // namespace froxel::render
