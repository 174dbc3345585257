#include "interface/constants.h"
#include "render/scene/scene_needs.h"

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
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], textureFlag(io::normal_slot));
    m.normal_texture.scale = {2, 2};
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              textureFlag(io::normal_slot) | io::kMaterialUvTransform);
}

TEST(SceneNeeds, IorOrSpecular_SetsTheFlagWhereItIsNotUsual) {
    EXPECT_FALSE(findNeeds(sceneWith(plain())).specular);
    auto dense = plain();
    dense.ior = 2;
    auto tinted = plain();
    tinted.specular_color = {1, 0.5F, 1};
    auto weak = plain();
    weak.specular = 0.5F;
    auto glossy = plain();
    glossy.specular_color_texture.texture = 0;
    glossy.glossiness_texture = true;
    for (const auto& m : {dense, tinted, weak, glossy}) {
        const auto needs = findNeeds(sceneWith(m));
        EXPECT_NE(needs.material_flags[0] & io::kMaterialSpecular, 0U);
        EXPECT_TRUE(needs.specular);
        EXPECT_EQ(needs.edges, m.specular != 1);
        EXPECT_FALSE(needs.wide_gbuffer);
    }
    EXPECT_EQ(findNeeds(sceneWith(glossy)).material_flags[0],
              io::kMaterialSpecular | textureFlag(io::specular_color_slot) |
                  io::kMaterialGlossiness);
    weak.alpha_mode = scene::AlphaMode::kBlend; // is not in the G-buffer
    EXPECT_FALSE(findNeeds(sceneWith(weak)).specular);
    EXPECT_TRUE(findNeeds(sceneWith(weak)).edges);
    dense.unlit = true;
    EXPECT_FALSE(findNeeds(sceneWith(dense)).specular);
    EXPECT_EQ(findNeeds(sceneWith(dense)).material_flags[0], io::kMaterialUnlit);
}

TEST(SceneNeeds, Coat_SetsItsFlagsWhereItHasStrength) {
    auto m = plain();
    m.coat.roughness = 0.5F;
    m.coat_texture.texture = 0;
    m.coat_roughness_texture.texture = 0;
    m.coat_normal_texture = {.texture = 0, .texcoord = 1};
    EXPECT_FALSE(findNeeds(sceneWith(m)).layers);
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U);
    m.coat.strength = 1;
    EXPECT_TRUE(findNeeds(sceneWith(m)).layers);
    EXPECT_FALSE(findNeeds(sceneWith(m)).wide_gbuffer);
    const MaterialFlags textures = textureFlag(io::coat_slot) |
                                   textureFlag(io::coat_roughness_slot) |
                                   textureFlag(io::coat_normal_slot);
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              textures | io::kMaterialCoat | io::kMaterialUvTransform);
    m.coat.roughness = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0] & textureFlag(io::coat_roughness_slot), 0U);
    m.alpha_mode = scene::AlphaMode::kBlend; // is forward anyway
    EXPECT_FALSE(findNeeds(sceneWith(m)).layers);
    EXPECT_NE(findNeeds(sceneWith(m)).material_flags[0] & io::kMaterialCoat, 0U);
    m.unlit = true;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0] & kLayerFlags, 0U);
}

TEST(SceneNeeds, Sheen_SetsItsFlagsWhereItHasAColor) {
    auto m = plain();
    m.sheen.roughness = 0.5F;
    m.sheen_color_texture.texture = 0;
    m.sheen_roughness_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U);
    m.sheen.color = {0, 0, 0.1F};
    EXPECT_TRUE(findNeeds(sceneWith(m)).layers);
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], textureFlag(io::sheen_color_slot) |
                                                             textureFlag(io::sheen_roughness_slot) |
                                                             io::kMaterialSheen);
    m.sheen.roughness = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              textureFlag(io::sheen_color_slot) | io::kMaterialSheen);
    m.unlit = true;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], io::kMaterialUnlit);
}

// Its direction is derived from coordinates, texture or none; no light is added up again.
TEST(SceneNeeds, Anisotropy_SetsItsFlagsWhereItHasStrength) {
    auto m = plain();
    m.anisotropy.rotation_rad = 1;
    m.anisotropy_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U);
    m.anisotropy.strength = 0.1F;
    const SceneNeeds needs = findNeeds(sceneWith(m));
    EXPECT_TRUE(needs.layers);
    EXPECT_EQ(needs.material_flags[0], textureFlag(io::anisotropy_slot) | io::kMaterialAnisotropy);
    EXPECT_EQ(litSurfaces(needs.material_flags[0]), 1);
    EXPECT_TRUE(fetchesCoordinates(io::kMaterialAnisotropy));
    EXPECT_FALSE(fetchesCoordinates(io::kMaterialCoat | io::kMaterialSheen));
}

TEST(SceneNeeds, Film_SetsItsFlagsWhereItHasStrength) {
    auto m = plain();
    m.film_texture.texture = 0;
    m.film_thickness_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U);
    m.film.strength = 0.1F;
    const SceneNeeds needs = findNeeds(sceneWith(m));
    EXPECT_TRUE(needs.layers);
    EXPECT_TRUE(needs.edges); // one Fresnel term for all that is scattered
    EXPECT_EQ(needs.material_flags[0], textureFlag(io::film_slot) |
                                           textureFlag(io::film_thickness_slot) |
                                           io::kMaterialFilm);
    EXPECT_EQ(litSurfaces(needs.material_flags[0]), 1);
    m.film.least_nm = m.film.most_nm;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              textureFlag(io::film_slot) | io::kMaterialFilm);
}

TEST(SceneNeeds, DiffuseTransmission_SetsItsFlagsWhereItHasStrength) {
    auto m = plain();
    m.diffuse_transmission_texture.texture = 0;
    m.diffuse_transmission_color_texture.texture = 0;
    m.thickness_texture.texture = 0;
    m.volume.thickness_m = 1;
    m.volume.attenuation_m = 1;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U) << "nothing comes through";
    m.diffuse_transmission.strength = 0.1F;
    const MaterialFlags own = textureFlag(io::diffuse_transmission_slot) |
                              textureFlag(io::diffuse_transmission_color_slot) |
                              io::kMaterialDiffuseTransmission;
    const SceneNeeds needs = findNeeds(sceneWith(m));
    EXPECT_TRUE(needs.layers);
    EXPECT_EQ(needs.material_flags[0], own | textureFlag(io::thickness_slot));
    EXPECT_EQ(litSurfaces(needs.material_flags[0]), 2) << "its other side is lit, too";
    m.volume.attenuation_m = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], own) << "nothing is dimmed";
}

TEST(SceneNeeds, Transmission_IsNeitherSolidNorBlended) {
    auto m = plain();
    m.roughness = 0;
    m.transmission_texture.texture = 0;
    m.thickness_texture.texture = 0;
    m.volume.thickness_m = 1;
    m.emissive = {1, 1, 1};
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], 0U) << "nothing passes";
    m.transmission.strength = 0.5F;
    const MaterialFlags own = textureFlag(io::transmission_slot) | textureFlag(io::thickness_slot) |
                              io::kMaterialTransmission | io::kMaterialBody;
    const SceneNeeds clear = findNeeds(sceneWith(m));
    EXPECT_EQ(clear.material_flags[0], own);
    EXPECT_TRUE(clear.transmissive);
    EXPECT_FALSE(clear.blended || clear.layers || clear.wide_gbuffer) << "not in the G-buffer";
    EXPECT_EQ(litSurfaces(clear.material_flags[0]), 2) << "its other side is lit, too";
    m.transmission.dispersion = 0.1F;
    m.roughness = 0.2F;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0],
              own | io::kMaterialDispersion | io::kMaterialFrosted);
    m.ior = 1;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0] & io::kMaterialFrosted, 0U)
        << "what bends nothing blurs nothing";
    m.volume.thickness_m = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0] &
                  (io::kMaterialBody | io::kMaterialDispersion | textureFlag(io::thickness_slot)),
              0U)
        << "a thin wall bends nothing";
    m.metallic = 1;
    EXPECT_FALSE(findNeeds(sceneWith(m)).transmissive) << "metal stops light";
    m.metallic_roughness_texture.texture = 0;
    EXPECT_TRUE(findNeeds(sceneWith(m)).transmissive) << "it may be metal in places";
    const SceneNeeds without = findNeeds(sceneWith(m), false);
    EXPECT_FALSE(without.transmissive) << "a device without room for layers draws it solid";
    EXPECT_TRUE(without.wide_gbuffer);
}

TEST(SceneNeeds, UnlitMaterial_DropsWhatItDoesNotShow) {
    auto m = plain();
    m.unlit = true;
    m.normal_texture.texture = 0;
    m.occlusion_texture.texture = 0;
    EXPECT_EQ(findNeeds(sceneWith(m)).material_flags[0], io::kMaterialUnlit);
}

} // namespace froxel::render
