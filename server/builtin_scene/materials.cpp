#include "builtin_scene/materials.h"

#include "builtin_scene/recipes.h"
#include "builtin_scene/shade.h"
#include "builtin_scene/surface.h"
#include "core/assert.h"
#include "core/parallel.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr float kGlassThickness = 0.007F; // of a goblet's wall, metres

struct Look {
    Surface surface;
    scene::Material material; // without textures
    std::optional<Recipe> recipe;
};

scene::Material opaque(const char* name, float roughness, float metallic = 0) {
    scene::Material material;
    material.name = name;
    material.roughness = roughness;
    material.metallic = metallic;
    return material;
}

scene::Material masked(const char* name, float roughness, float metallic = 0) {
    scene::Material material = opaque(name, roughness, metallic);
    material.alpha_mode = scene::AlphaMode::kMask;
    material.double_sided = true;
    return material;
}

scene::Material blended(const char* name, float roughness, glm::vec4 color) {
    scene::Material material = opaque(name, roughness);
    material.alpha_mode = scene::AlphaMode::kBlend;
    material.base_color = color;
    return material;
}

// tint: of white light that passes a wall of it.
scene::Material glass(const char* name, glm::vec3 tint) {
    scene::Material material = opaque(name, 0.03F);
    material.transmission.strength = 1;
    material.volume = {.attenuation_color = tint,
                       .attenuation_m = kGlassThickness,
                       .thickness_m = kGlassThickness};
    return material;
}

scene::Material glowing(const char* name, glm::vec3 emissive) {
    scene::Material material = opaque(name, 1.0F);
    material.base_color = {0.02F, 0.02F, 0.02F, 1.0F};
    material.emissive = emissive;
    return material;
}

// Where a recipe bakes an orm map the factors are 1 and the map decides.
std::vector<Look> looks() {
    scene::Material cloth = opaque("cloth", 1, 1);
    cloth.double_sided = true;
    scene::Material fringe = opaque("fringe", 0.55F, 0.7F);
    fringe.base_color = {0.75F, 0.47F, 0.14F, 1.0F};
    fringe.double_sided = true;
    scene::Material stained = blended("stained_glass", 0.12F, glm::vec4(1));
    stained.emissive = glm::vec3(0.55F);
    return {
        {Surface::kAshlar, opaque("ashlar", 0.80F), ashlarRecipe()},
        {Surface::kLimestone, opaque("limestone", 0.64F), limestoneRecipe()},
        {Surface::kPavonazzetto, opaque("pavonazzetto", 0.28F), pavonazzettoRecipe()},
        {Surface::kVerde, opaque("verde", 0.20F), verdeRecipe()},
        {Surface::kRosso, opaque("rosso", 0.22F), rossoRecipe()},
        {Surface::kGiallo, opaque("giallo", 0.25F), gialloRecipe()},
        {Surface::kInlay, opaque("inlay", 0.24F), inlayRecipe()},
        {Surface::kHerringbone, opaque("herringbone", 0.62F), herringboneRecipe()},
        {Surface::kPlaster, opaque("plaster", 0.9F), plasterRecipe()},
        {Surface::kStars, opaque("stars", 1, 1), starsRecipe()},
        {Surface::kMosaic, opaque("mosaic", 1, 1), mosaicRecipe()},
        {Surface::kBronze, opaque("bronze", 1, 1), bronzeRecipe()},
        {Surface::kGold,
         [] {
             scene::Material gold = opaque("gold", 0.30F, 0.88F);
             gold.base_color = {1.0F, 0.72F, 0.32F, 1.0F};
             return gold;
         }(),
         std::nullopt},
        {Surface::kWood, opaque("wood", 0.55F), woodRecipe()},
        {Surface::kCloth, cloth, clothRecipe()},
        {Surface::kFringe, fringe, std::nullopt},
        {Surface::kTerracotta, opaque("terracotta", 0.85F), terracottaRecipe()},
        {Surface::kSoil, opaque("soil", 0.95F), soilRecipe()},
        {Surface::kIvy, masked("ivy", 0.5F), ivyRecipe()},
        {Surface::kFern, masked("fern", 0.55F), fernRecipe()},
        {Surface::kGrille, masked("grille", 1, 1), grilleRecipe()},
        {Surface::kGlass, blended("glass", 0.06F, {0.75F, 0.85F, 0.86F, 0.18F}), std::nullopt},
        {Surface::kStainedGlass, stained, stainedGlassRecipe()},
        {Surface::kWater, blended("water", 0.08F, glm::vec4(1)), waterRecipe()},
        {Surface::kRubyPane, blended("ruby_pane", 0.10F, {0.80F, 0.06F, 0.10F, 0.42F}),
         std::nullopt},
        {Surface::kCobaltPane, blended("cobalt_pane", 0.10F, {0.05F, 0.16F, 0.75F, 0.42F}),
         std::nullopt},
        {Surface::kRubyGlass, glass("ruby_glass", {0.86F, 0.20F, 0.25F}), std::nullopt},
        {Surface::kCobaltGlass, glass("cobalt_glass", {0.22F, 0.36F, 0.90F}), std::nullopt},
        {Surface::kAmberGlass, glass("amber_glass", {0.95F, 0.66F, 0.22F}), std::nullopt},
        {Surface::kSky, glowing("sky", {0.08F, 0.14F, 0.29F}), std::nullopt},
        {Surface::kFlame, glowing("flame", {6.0F, 3.4F, 1.3F}), std::nullopt},
    };
}

// Bakes every recipe; the work is shared by threads, the result does not depend on them.
std::vector<BakedMaps> bakeAll(const std::vector<Look>& table) {
    std::vector<BakedMaps> maps(table.size());
    constexpr size_t kMostThreads = 8;
    eachOnThreads(table.size(), std::min(threadCount(table.size(), 1), kMostThreads),
                  [&](size_t i) {
                      if (table[i].recipe) {
                          maps[i] = bake(*table[i].recipe);
                      }
                  });
    return maps;
}

scene::TextureSlot addTexture(scene::Scene& scene, scene::Image image, float tile_m) {
    const auto index = static_cast<uint32_t>(scene.textures.size());
    scene.textures.push_back({static_cast<uint32_t>(scene.images.size()), 0});
    scene.images.push_back(std::move(image));
    scene::TextureSlot slot;
    slot.texture = index;
    slot.scale = glm::vec2(1.0F / tile_m);
    return slot;
}

} // namespace

void addMaterials(scene::Scene& scene) {
    const std::vector<Look> table = looks();
    FROXEL_ASSERT(table.size() == static_cast<size_t>(Surface::kCount), "every surface has a look");
    std::vector<BakedMaps> baked = bakeAll(table);
    scene.samplers.push_back({});
    for (size_t i = 0; i < table.size(); ++i) {
        FROXEL_ASSERT(static_cast<size_t>(table[i].surface) == i, "looks are in Surface's order");
        scene::Material material = table[i].material;
        if (table[i].recipe) {
            const float tile_m = table[i].recipe->tile_m;
            material.base_color_texture = addTexture(scene, std::move(baked[i].color), tile_m);
            if (table[i].surface == Surface::kStainedGlass) {
                material.emissive_texture = material.base_color_texture;
            }
            if (table[i].recipe->normal) {
                material.normal_texture = addTexture(scene, std::move(baked[i].normal), tile_m);
            }
            if (table[i].recipe->orm) {
                material.metallic_roughness_texture =
                    addTexture(scene, std::move(baked[i].orm), tile_m);
                material.occlusion_texture = material.metallic_roughness_texture;
            }
        }
        scene.materials.push_back(std::move(material));
    }
}

} // namespace froxel::builtin_scene
