// A scene's surfaces as one of its material variants has them.
#pragma once

#include "gpu/upload.h"
#include "interface/constants.h"
#include "render/scene/geometry_pack.h"
#include "render/scene/scene_needs.h"
#include "render/scene/visibility_scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
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

[[nodiscard]] inline bool isSolid(const DrawItem& item) {
    return isSolid(item.material_flags);
}
// Of any of them that is solid.
[[nodiscard]] MaterialFlags solidFlags(std::span<const DrawItem> items);

// Used by the render thread; frames on the device hold the one that they draw.
class MaterialSet {
  public:
    MaterialSet(SceneResources& scene, std::vector<DrawItem> items);

    // As they stand at time 0, where the scene moves; a frame has its ScenePose.
    const std::vector<DrawItem> items;
    const SurfaceNeeds needs;
    const MaterialFlags solid_flags; // of the items
    // Why; empty: visibility passes can draw it.
    [[nodiscard]] const std::string& visibilityUnusable(Detail detail = Detail::kExact) const {
        return unusable_[static_cast<size_t>(detail)];
    }

    // Made at the first call; visibilityUnusable() is empty. Throws vk::SystemError.
    [[nodiscard]] VisibilityScene& visibility(Detail detail = Detail::kExact);

  private:
    SceneResources& scene_;
    const std::array<std::string, 2> unusable_; // of each Detail
    std::array<std::unique_ptr<VisibilityScene>, 2> visibility_;
};

} // namespace froxel::render
