#include "builtin_scene/noise.h"
#include "builtin_scene/recipes.h"
#include "builtin_scene/shade.h"

#include <cmath>

namespace froxel::builtin_scene {

Recipe bronzeRecipe() {
    return {.name = "bronze", .size_px = 256, .tile_m = 1.0F, .at = [](glm::vec2 uv) {
                const float cloud = fractalNoise(uv * 5.0F, 5, 4, 1210);
                const float grain = fractalNoise(uv * 24.0F, 24, 3, 1220);
                const float patina = ramp(0.05F, 0.42F, cloud + 0.25F * grain);
                Texel texel;
                texel.color = blend(rgb(0x8a6238), rgb(0xb98a52), saturate(0.5F + grain));
                texel.color = blend(texel.color, rgb(0x5f9a86), 0.85F * patina);
                texel.height_m = 0.0005F * grain + 0.0008F * patina;
                texel.metallic = 0.85F - 0.70F * patina;
                texel.roughness = 0.38F + 0.40F * patina + 0.08F * grain;
                return texel;
            }};
}

Recipe woodRecipe() {
    return {.name = "wood", .size_px = 256, .tile_m = 1.0F, .orm = false, .at = [](glm::vec2 uv) {
                // Grain runs along u; planks of 0.25 m.
                const auto plank = static_cast<int32_t>(uv.y * 4.0F);
                const float edge_m = std::abs(uv.y * 4.0F - std::round(uv.y * 4.0F)) * 0.25F;
                const float shift = randomAt(plank, 0, 1300);
                const float fibre =
                    fractalNoise(glm::vec2(uv.x * 3.0F, uv.y * 48.0F + shift), 3, 4, 1310);
                const float ring = fractalNoise(glm::vec2(uv.x * 2.0F, uv.y * 8.0F), 2, 3, 1320);
                const float seam = 1.0F - ramp(0.002F, 0.006F, edge_m);
                Texel texel;
                texel.color =
                    blend(rgb(0x4a2f1c), rgb(0x7a5231), ramp(-0.5F, 0.6F, ring + 0.5F * fibre));
                texel.color *= (0.85F + 0.3F * shift) * (1.0F - 0.6F * seam);
                texel.height_m = 0.0012F * fibre - 0.004F * seam;
                return texel;
            }};
}

// Damask: an ogee lattice with a gold flower, over a twill.
Recipe clothRecipe() {
    return {.name = "cloth", .size_px = 256, .tile_m = 0.5F, .at = [](glm::vec2 uv) {
                constexpr float kTau = glm::two_pi<float>();
                const glm::vec2 p = uv * kTau;
                const float lattice = std::cos(p.x) + std::cos(p.y) * 0.8F +
                                      0.3F * std::cos(2.0F * p.x + p.y) +
                                      0.3F * std::cos(2.0F * p.x - p.y);
                const float band = 1.0F - ramp(0.06F, 0.14F, std::abs(lattice - 0.1F));
                const float flower = ramp(
                    1.35F, 1.5F, lattice + 0.35F * std::cos(4.0F * p.x) * std::cos(4.0F * p.y));
                const float figure = std::max(band, flower);
                const float twill = std::sin((uv.x + uv.y) * kTau * 48.0F);
                const float fade = fractalNoise(uv * 4.0F, 4, 3, 1410);
                Texel texel;
                texel.color = blend(rgb(0x5c1224), rgb(0x7d1c30), saturate(0.5F + fade));
                texel.color = blend(texel.color, rgb(0xc79a45), 0.9F * figure);
                texel.color *= 1.0F + 0.05F * twill;
                texel.height_m = 0.0002F * twill + 0.0006F * figure;
                texel.roughness = 0.85F - 0.35F * figure;
                texel.metallic = 0.6F * figure;
                return texel;
            }};
}

Recipe terracottaRecipe() {
    return {
        .name = "terracotta", .size_px = 256, .tile_m = 1.0F, .orm = false, .at = [](glm::vec2 uv) {
            const float turned = fractalNoise(glm::vec2(uv.x * 2.0F, uv.y * 48.0F), 2, 3, 1510);
            const float bloom = ramp(0.0F, 0.6F, fractalNoise(uv * 4.0F, 4, 4, 1520));
            Texel texel;
            texel.color = blend(rgb(0xb0623c), rgb(0xc98055), saturate(0.5F + turned));
            texel.color = blend(texel.color, rgb(0xd8c3a8), 0.45F * bloom);
            texel.height_m = 0.0012F * turned;
            return texel;
        }};
}

Recipe soilRecipe() {
    return {.name = "soil", .size_px = 256, .tile_m = 1.0F, .orm = false, .at = [](glm::vec2 uv) {
                const CellNoise crumb = cellNoise(uv * 24.0F, 24, 1610);
                const float cloud = fractalNoise(uv * 6.0F, 6, 4, 1620);
                Texel texel;
                texel.color = blend(rgb(0x33241a), rgb(0x5a4330), saturate(0.5F + cloud));
                const bool moss = (crumb.id & 7U) < 2U;
                texel.color = blend(texel.color, rgb(0x4d5f2a), moss ? 0.7F : 0.0F);
                texel.height_m = 0.012F * (1.0F - ramp(0.0F, 0.6F, crumb.nearest)) + 0.006F * cloud;
                return texel;
            }};
}

Recipe waterRecipe() {
    return {.name = "water", .size_px = 256, .tile_m = 2.0F, .orm = false, .at = [](glm::vec2 uv) {
                const float swell = fractalNoise(uv * 6.0F, 6, 3, 1710);
                const float crest = std::abs(fractalNoise(uv * 8.0F, 8, 3, 1720));
                Texel texel;
                texel.color = blend(rgb(0x16464c), rgb(0x2b6f70), saturate(0.5F + swell));
                texel.alpha = 0.72F;
                texel.height_m = 0.018F * swell - 0.012F * crest;
                return texel;
            }};
}

} // namespace froxel::builtin_scene
