#include "interface/constants.h"
#include "render/scene_needs.h"

#include <gtest/gtest.h>

namespace froxel::render {

namespace {

scene::Scene sceneWith(const scene::Material& material) {
    scene::Scene scene;
    scene.materials.push_back(material);
    return scene;
}

scene::Material plain() {
    scene::Material m;
    m.metallic = 0;
    return m;
}

} // namespace

TEST(SceneNeeds, PlainMaterial_NeedsNothing) {
    const auto needs = findNeeds(sceneWith(plain()));
    EXPECT_EQ(needs.material_flags[0], 0U);
    EXPECT_FALSE(needs.wide_gbuffer);
    EXPECT_FALSE(needs.masked);
    EXPECT_FALSE(needs.blended);
}

TEST(SceneNeeds, MetalEmissionOrUnlit_NeedsTheWideGbuffer) {
    auto metal = plain();
    metal.metallic = 0.5F;
    auto lamp = plain();
    lamp.emissive = {1, 0, 0};
    auto unlit = plain();
    unlit.unlit = true;
    for (const auto& m : {metal, lamp, unlit}) {
        EXPECT_TRUE(findNeeds(sceneWith(m)).wide_gbuffer);
    }
}

TEST(SceneNeeds, TransformedSlot_SetsTheTransformFlag) {
    auto m = plain();
    m.normal_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], io::kMaterialNormalTexture);
    m.normal_texture.scale = {2, 2};
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              io::kMaterialNormalTexture | io::kMaterialUvTransform);
}

TEST(SceneNeeds, UnlitMaterial_DropsWhatItDoesNotShow) {
    auto m = plain();
    m.unlit = true;
    m.normal_texture.texture = 0;
    m.occlusion_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], io::kMaterialUnlit);
}

} // namespace froxel::render
