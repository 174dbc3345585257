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
[[nodiscard]] constexpr bool isOf(Surfaces surfaces, MaterialFlags material_flags) {
    return surfaces == Surfaces::kSolid ? isSolid(material_flags) : isTransmissive(material_flags);
}
// Of any of them that is such a surface.
[[nodiscard]] MaterialFlags flagsOf(std::span<const DrawItem> items, Surfaces surfaces);

// Used by the render thread; frames on the device hold the one that they draw.
class MaterialSet {
  public:
    MaterialSet(SceneResources& scene, std::vector<DrawItem> items);

    // As they stand at time 0, where the scene moves; a frame has its ScenePose.
    const std::vector<DrawItem> items;
    const SurfaceNeeds needs;
    const MaterialFlags solid_flags; // of the items
    // Why; empty: visibility passes can draw it.
    [[nodiscard]] const std::string&
    visibilityUnusable(Detail detail = Detail::kExact, Surfaces surfaces = Surfaces::kSolid) const {
        return unusable_[index(surfaces, detail)];
    }

    // Made at the first call; visibilityUnusable() is empty. Throws vk::SystemError.
    [[nodiscard]] VisibilityScene& visibility(Detail detail = Detail::kExact,
                                              Surfaces surfaces = Surfaces::kSolid);

  private:
    // Of each Surfaces, of each Detail.
    static constexpr size_t kKinds = 4;
    static constexpr size_t index(Surfaces surfaces, Detail detail) {
        return 2 * static_cast<size_t>(surfaces) + static_cast<size_t>(detail);
    }
    static std::array<std::string, kKinds> findUnusable(const SceneResources& scene,
                                                        std::span<const DrawItem> items);

    SceneResources& scene_;
    const std::array<std::string, kKinds> unusable_;
    std::array<std::unique_ptr<VisibilityScene>, kKinds> visibility_;
};

} // namespace froxel::render
