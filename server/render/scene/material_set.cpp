#include "render/scene/material_set.h"

#include "render/scene/scene_resources.h"

#include <utility>

namespace froxel::render {

namespace {

SurfaceNeeds needsOf(const SceneResources& scene, const std::vector<DrawItem>& items) {
    SurfaceNeeds needs;
    for (const DrawItem& item : items) {
        needs.add(scene.needs.of_material[item.primitive.material]);
    }
    return needs;
}

} // namespace

MaterialFlags solidFlags(std::span<const DrawItem> items) {
    MaterialFlags flags = 0;
    for (const DrawItem& item : items) {
        flags |= isSolid(item) ? item.material_flags : 0;
    }
    return flags;
}

MaterialSet::MaterialSet(SceneResources& scene, std::vector<DrawItem> items_in)
    : items(std::move(items_in)), needs(needsOf(scene, items)), solid_flags(solidFlags(items)),
      scene_(scene), unusable_{VisibilityScene::unusable(scene, items, Detail::kExact),
                               VisibilityScene::unusable(scene, items, Detail::kLevels)} {}

VisibilityScene& MaterialSet::visibility(Detail detail) {
    auto& visibility = visibility_[static_cast<size_t>(detail)];
    if (!visibility) {
        gpu::Uploader uploader(scene_.shared.device, kStagingBytes);
        visibility = std::make_unique<VisibilityScene>(scene_, items, detail, uploader);
        uploader.finish(scene_.shared.timeline);
    }
    return *visibility;
}

} // namespace froxel::render
