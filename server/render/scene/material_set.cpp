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

MaterialSet::MaterialSet(SceneResources& scene, std::vector<DrawItem> items_in)
    : items(std::move(items_in)), needs(needsOf(scene, items)),
      visibility_unusable(VisibilityScene::unusable(scene, items)), scene_(scene) {}

VisibilityScene& MaterialSet::visibility() {
    if (!visibility_) {
        gpu::Uploader uploader(scene_.shared.device, kStagingBytes);
        visibility_ = std::make_unique<VisibilityScene>(scene_, items, uploader);
        uploader.finish(scene_.shared.timeline);
    }
    return *visibility_;
}

} // namespace froxel::render
