// One view's posed vertices, among what its frames draw into.
#pragma once

#include "render/frame/frame_slot.h"
#include "render/scene/mesh_poser.h"
#include "render/scene/scene_resources.h"

namespace froxel::render {

struct PosedTargets final : StepTargets {
    explicit PosedTargets(const SceneResources& scene) : vertices(scene) {}

    void forgetDrawn() override { vertices.pose.reset(); }
    void begin() override { vertices.fresh = true; }

    PosedVertices vertices;
};

// Those of the slot's frame; the scene's where no mesh bends.
[[nodiscard]] inline VertexBuffers vertexBuffers(const SceneResources& scene,
                                                 const FrameSlot& slot) {
    const auto* posed = slot.step_targets.find<PosedTargets>();
    return vertexBuffers(scene, posed != nullptr ? &posed->vertices : nullptr);
}

} // namespace froxel::render
