// A scene's surfaces as one of its material variants has them.
#pragma once

#include "gpu/upload.h"
#include "render/scene/geometry_pack.h"
#include "render/scene/scene_needs.h"
#include "render/scene/visibility_scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace froxel::render {

// One primitive of one instance: what culling looks at and what a draw needs.
struct DrawItem {
    uint32_t instance = 0;
    PackedPrimitive primitive;
    MaterialFlags material_flags = 0; // with kMaterialExtended and kMaterialTangents
    bool mirrored = false;            // the instance turns the winding round
    bool bends = false;               // of its meshlets nothing but the primitive's sphere is known
};

// Used by the render thread; frames on the device hold the one that they draw.
class MaterialSet {
  public:
    MaterialSet(SceneResources& scene, std::vector<DrawItem> items);

    // As they stand at time 0, where the scene moves; a frame has its ScenePose.
    const std::vector<DrawItem> items;
    const SurfaceNeeds needs;
    const std::string visibility_unusable; // why; empty: visibility passes can draw it

    // Made at the first call; visibility_unusable is empty. Throws vk::SystemError.
    [[nodiscard]] VisibilityScene& visibility();

  private:
    SceneResources& scene_;
    std::unique_ptr<VisibilityScene> visibility_;
};

} // namespace froxel::render
