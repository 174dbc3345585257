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

MaterialFlags flagsOf(std::span<const DrawItem> items, Surfaces surfaces) {
    MaterialFlags flags = 0;
    for (const DrawItem& item : items) {
        flags |= isOf(surfaces, item.material_flags) ? item.material_flags : 0;
    }
    return flags;
}

MaterialSet::MaterialSet(SceneResources& scene, std::vector<DrawItem> items_in)
    : items(std::move(items_in)), needs(needsOf(scene, items)),
      solid_flags(flagsOf(items, Surfaces::kSolid)), scene_(scene),
      unusable_(findUnusable(scene, items)) {}

std::array<std::string, MaterialSet::kKinds>
MaterialSet::findUnusable(const SceneResources& scene, std::span<const DrawItem> items) {
    std::array<std::string, kKinds> unusable;
    for (const Surfaces surfaces : {Surfaces::kSolid, Surfaces::kTransmissive}) {
        for (const Detail detail : {Detail::kExact, Detail::kLevels}) {
            unusable[index(surfaces, detail)] =
                VisibilityScene::unusable(scene, items, surfaces, detail);
        }
    }
    return unusable;
}

VisibilityScene& MaterialSet::visibility(Detail detail, Surfaces surfaces) {
    auto& visibility = visibility_[index(surfaces, detail)];
    if (!visibility) {
        gpu::Uploader uploader(scene_.shared.device, kStagingBytes);
        visibility = std::make_unique<VisibilityScene>(scene_, items, surfaces, detail, uploader);
        uploader.finish(scene_.shared.timeline);
    }
    return *visibility;
}

} // namespace froxel::render
