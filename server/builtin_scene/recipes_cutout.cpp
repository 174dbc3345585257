#include "builtin_scene/noise.h"
#include "builtin_scene/recipes.h"
#include "builtin_scene/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

constexpr float kTau = glm::two_pi<float>();

struct Leaf {
    float inside = 0; // positive inside, about metres of the texture's unit square
    float rib = 0;    // 1 on a rib
    float along = 0;  // 0 at the stalk, 1 at the tip
};

// A five-lobed ivy leaf of unit length from `stalk` along `axis`.
Leaf ivyLeaf(glm::vec2 p, glm::vec2 stalk, glm::vec2 axis, float length) {
    const glm::vec2 d = (p - stalk) / length;
    const float x = glm::dot(d, glm::vec2(axis.y, -axis.x));
    const float y = glm::dot(d, axis);
    const glm::vec2 centre(0.0F, 0.38F);
    const glm::vec2 q = glm::vec2(x, y) - centre;
    const float angle = std::atan2(q.x, q.y);
    const float lobes = std::abs(std::cos(angle * 2.5F));
    const float reach = 0.30F + 0.30F * std::pow(lobes, 1.3F) * (0.62F + 0.38F * std::cos(angle));
    Leaf leaf;
    leaf.inside = (reach - glm::length(q)) * length;
    leaf.along = saturate(y);
    const float spoke = std::abs(std::sin(angle * 2.5F)) * glm::length(q);
    leaf.rib = 1.0F - ramp(0.008F, 0.03F, spoke);
    return leaf;
}

} // namespace

// A spray of leaves on a square card; the border is empty.
Recipe ivyRecipe() {
    return {.name = "ivy", .size_px = 256, .tile_m = 0.6F, .orm = false, .at = [](glm::vec2 uv) {
                // Later leaves lie on top: an outer ring, an inner ring, one in the middle.
                constexpr int32_t kOuter = 9;
                constexpr int32_t kInner = 6;
                Texel texel;
                texel.color = rgb(0x2c4a1f);
                texel.alpha = 0;
                for (int32_t i = 0; i <= kOuter + kInner; ++i) {
                    const bool outer = i < kOuter;
                    const bool middle = i == kOuter + kInner;
                    const float around = outer ? static_cast<float>(i) / kOuter
                                               : static_cast<float>(i - kOuter) / kInner + 0.07F;
                    const float turn = (around + 0.08F * (randomAt(i, 1, 1800) - 0.5F)) * kTau;
                    const glm::vec2 axis(std::sin(turn), -std::cos(turn));
                    const float length = 0.25F + 0.06F * randomAt(i, 2, 1800);
                    const float from = outer ? 0.20F : middle ? -0.10F : 0.05F;
                    const Leaf leaf = ivyLeaf(uv, glm::vec2(0.5F) + axis * from, axis, length);
                    const float cover = ramp(-0.004F, 0.004F, leaf.inside);
                    if (cover <= 0) {
                        continue;
                    }
                    const float tone = randomAt(i, 3, 1800);
                    glm::vec3 green = blend(rgb(0x2f5a22), rgb(0x6f9440), tone);
                    green = blend(green, rgb(0x8fae5c), 0.6F * leaf.rib);
                    green *= 0.75F + 0.45F * ramp(0.0F, 0.025F, leaf.inside);
                    green *= 1.0F + 0.12F * fractalNoise(uv * 16.0F, 16, 2, 1810);
                    texel.color = blend(texel.color, green, cover);
                    texel.alpha = std::max(texel.alpha, cover);
                    texel.height_m = 0.01F * ramp(0.0F, 0.06F, leaf.inside) + 0.003F * leaf.rib +
                                     0.01F * static_cast<float>(i);
                }
                return texel;
            }};
}

// One pinnate frond, its stalk at the bottom edge, its tip at the top.
Recipe fernRecipe() {
    return {.name = "fern", .size_px = 256, .tile_m = 0.8F, .orm = false, .at = [](glm::vec2 uv) {
                const float along = 1.0F - uv.y; // 0 at the stalk
                const float side = std::abs(uv.x - 0.5F);
                // Leaflets sweep forward; each is a lens, shorter towards the tip and the stalk.
                const float lean = along - side * 0.55F;
                const float pitch = lean * 15.0F;
                const float in_leaflet = pitch - std::floor(pitch) - 0.5F;
                const float spread =
                    0.44F * std::pow(saturate(std::sin(saturate(along * 0.97F) * 3.05F)), 0.7F);
                const float reach = saturate(side / std::max(spread, 0.001F));
                const float width = 0.42F * std::sqrt(std::max(0.0F, 1.0F - reach * reach));
                const bool grown = lean > 0.06F && along < 0.985F && reach < 1.0F;
                const float blade =
                    grown ? ramp(-0.05F, 0.05F, width - std::abs(in_leaflet)) : 0.0F;
                const float stalk = along < 0.95F ? 1.0F - ramp(0.006F, 0.013F, side) : 0.0F;
                Texel texel;
                texel.alpha = std::max(blade, stalk);
                texel.color =
                    blend(rgb(0x3c6b26), rgb(0x86ad4c), saturate(reach * 0.6F + along * 0.4F));
                texel.color *= 0.85F + 0.3F * (0.5F - std::abs(in_leaflet));
                texel.color = blend(texel.color, rgb(0x5d5a2a), 0.7F * stalk);
                texel.height_m = 0.01F * blade * (0.5F - std::abs(in_leaflet)) + 0.006F * stalk;
                return texel;
            }};
}

// Bars of a bronze lattice: a square grid, a ring round every crossing and a quatrefoil between.
Recipe grilleRecipe() {
    return {.name = "grille", .size_px = 256, .tile_m = 0.5F, .at = [](glm::vec2 uv) {
                const glm::vec2 p = uv * 2.0F - glm::floor(uv * 2.0F) - 0.5F;
                const glm::vec2 a = glm::abs(p);
                const auto bar = [](float distance, float half) {
                    return half - std::abs(distance);
                };
                const float grid = bar(std::min(a.x, a.y), 0.045F);
                const float ring = bar(glm::length(p) - 0.21F, 0.038F);
                const float foil = bar(glm::length(a - glm::vec2(0.5F)) - 0.24F, 0.034F);
                const float inside = std::max({grid, ring, foil});
                const float cloud = fractalNoise(uv * 6.0F, 6, 4, 1910);
                const float patina = ramp(-0.1F, 0.5F, cloud);
                Texel texel;
                texel.alpha = ramp(-0.012F, 0.012F, inside);
                texel.color = blend(rgb(0x8d6a40), rgb(0x5b9180), 0.7F * patina);
                texel.height_m = 0.006F * ramp(0.0F, 0.045F, inside);
                texel.metallic = 1.0F - 0.7F * patina;
                texel.roughness = 0.4F + 0.3F * patina;
                return texel;
            }};
}

// Lozenge quarries in lead; the colour also feeds the emission, as a window glows by its sky.
Recipe stainedGlassRecipe() {
    return {.name = "stained_glass",
            .size_px = 256,
            .tile_m = 1.0F,
            .normal = false,
            .orm = false,
            .at = [](glm::vec2 uv) {
                const glm::vec2 p((uv.x + uv.y) * 4.0F, (uv.x - uv.y) * 4.0F);
                const glm::vec2 cell = glm::floor(p);
                const glm::vec2 f = p - cell;
                const float edge = std::min(std::min(f.x, 1.0F - f.x), std::min(f.y, 1.0F - f.y));
                // Cells repeat with the tile: (a, b) is the same pane as (a + 4, b + 4) and (a + 4,
                // b - 4).
                const auto a = static_cast<int32_t>(cell.x);
                const auto b = static_cast<int32_t>(cell.y);
                const int32_t sum = ((a + b) % 8 + 8) % 8;
                const int32_t difference = ((a - b) % 8 + 8) % 8;
                constexpr std::array<glm::vec3, 6> kPanes = {rgb(0x2a55a8), rgb(0x3f86b5),
                                                             rgb(0xa8322d), rgb(0xd9a441),
                                                             rgb(0x3d8f5b), rgb(0x6a4aa0)};
                const uint32_t id = hashLattice(sum, difference, 2010);
                const float lead = 1.0F - ramp(0.035F, 0.06F, edge);
                const float seed = fractalNoise(uv * 8.0F, 8, 3, 2020);
                Texel texel;
                texel.color = kPanes[id % kPanes.size()] * (0.95F + 0.25F * seed);
                texel.color = blend(texel.color, rgb(0x14110d), lead);
                texel.alpha = 0.72F + 0.28F * lead;
                return texel;
            }};
}

} // namespace froxel::builtin_scene
