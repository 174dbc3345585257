#include "builtin_scene/noise.h"
#include "builtin_scene/recipes.h"
#include "builtin_scene/shade.h"

#include <cmath>

namespace froxel::builtin_scene {
namespace {

// Polished marble: a ground, clouds, and veins where warped noise crosses zero.
struct MarbleLook {
    glm::vec3 ground, cloud, vein;
    float vein_width = 0.08F;
    float vein_strength = 1;
    float warp = 1.2F;
    uint32_t seed = 0;
};

Texel marble(glm::vec2 uv, const MarbleLook& look) {
    const glm::vec2 p = uv * 4.0F;
    const glm::vec2 bend(fractalNoise(p, 4, 3, look.seed), fractalNoise(p, 4, 3, look.seed + 11));
    const glm::vec2 q = p + bend * look.warp;
    const float cloud = fractalNoise(q, 4, 4, look.seed + 23);
    const float broad = std::abs(fractalNoise(q, 4, 3, look.seed + 37));
    const float fine = std::abs(fractalNoise(q * 2.0F, 8, 3, look.seed + 41));
    const float vein = (1.0F - ramp(0.0F, look.vein_width, broad)) +
                       0.5F * (1.0F - ramp(0.0F, look.vein_width * 0.6F, fine));
    Texel texel;
    texel.color = blend(look.ground, look.cloud, ramp(-0.45F, 0.5F, cloud));
    texel.color = blend(texel.color, look.vein, saturate(vein * look.vein_strength));
    return texel;
}

Recipe marbleRecipe(const char* name, const MarbleLook& look) {
    return {.name = name,
            .size_px = 256,
            .tile_m = 2.0F,
            .normal = false,
            .orm = false,
            .at = [look](glm::vec2 uv) { return marble(uv, look); }};
}

// Travertine's body: warm bands and pits along the bed.
Texel travertine(glm::vec2 uv, int32_t period, uint32_t seed) {
    const auto scale = static_cast<float>(period);
    const glm::vec2 bed(uv.x * scale, uv.y * scale * 2.0F);
    const float band = fractalNoise(bed, period, 4, seed);
    const float grain = fractalNoise(uv * scale * 8.0F, period * 8, 2, seed + 5);
    const float pits = fractalNoise(glm::vec2(bed.x * 2.0F, bed.y * 4.0F), period * 2, 2, seed + 9);
    const float pit = ramp(0.33F, 0.5F, pits);
    Texel texel;
    texel.color = blend(rgb(0xd9c6a5), rgb(0xc2a67e), ramp(-0.5F, 0.5F, band));
    texel.color *= 1.0F + 0.06F * grain;
    texel.color = blend(texel.color, rgb(0x8f7450), 0.6F * pit);
    texel.height_m = 0.0015F * grain + 0.0012F * band - 0.004F * pit;
    return texel;
}

} // namespace

// Two metres square: four courses of half a metre, blocks of a metre, every other course shifted.
Recipe ashlarRecipe() {
    return {.name = "ashlar", .size_px = 512, .tile_m = 2.0F, .orm = false, .at = [](glm::vec2 uv) {
                const float course = std::floor(uv.y * 4.0F);
                const auto row = static_cast<int32_t>(course);
                const float shift = (row & 1) != 0 ? 0.25F : 0.0F;
                const float across = (uv.x + shift) * 2.0F;
                const auto column = static_cast<int32_t>(std::floor(across)) & 1;
                const glm::vec2 in_block(across - std::floor(across), uv.y * 4.0F - course);
                // Distance to the block's edge in metres.
                const float edge_x = std::min(in_block.x, 1.0F - in_block.x) * 1.0F;
                const float edge_y = std::min(in_block.y, 1.0F - in_block.y) * 0.5F;
                const float wobble = 0.004F * fractalNoise(uv * 16.0F, 16, 2, 71);
                const float edge = std::min(edge_x, edge_y) + wobble;
                const float joint = 1.0F - ramp(0.004F, 0.009F, edge);
                const float dress = ramp(0.006F, 0.022F, edge);

                const uint32_t id = hashLattice(column, row, 4);
                Texel texel = travertine(uv, 4, 100);
                const float tone = static_cast<float>(id & 255U) / 255.0F;
                texel.color *= 0.88F + 0.17F * tone;
                texel.color = blend(texel.color, texel.color * glm::vec3(1.04F, 0.97F, 0.88F),
                                    static_cast<float>((id >> 8U) & 255U) / 255.0F);
                const float stain = ramp(-0.1F, 0.6F, fractalNoise(uv * 3.0F, 3, 3, 55));
                texel.color *= 1.0F - 0.14F * stain;
                texel.color = blend(texel.color, rgb(0x9d8868), 0.85F * joint);
                texel.height_m = texel.height_m * (1.0F - joint) + 0.010F * dress;
                return texel;
            }};
}

Recipe limestoneRecipe() {
    return {
        .name = "limestone", .size_px = 256, .tile_m = 1.0F, .orm = false, .at = [](glm::vec2 uv) {
            const float cloud = fractalNoise(uv * 3.0F, 3, 4, 210);
            const float grain = fractalNoise(uv * 24.0F, 24, 3, 220);
            const float fleck = ramp(0.3F, 0.55F, fractalNoise(uv * 12.0F, 12, 2, 230));
            Texel texel;
            texel.color = blend(rgb(0xe2d3b6), rgb(0xcdb791), ramp(-0.5F, 0.6F, cloud));
            texel.color *= 1.0F + 0.05F * grain;
            texel.color = blend(texel.color, rgb(0xb39a72), 0.35F * fleck);
            texel.height_m = 0.0007F * grain + 0.001F * cloud - 0.0012F * fleck;
            return texel;
        }};
}

Recipe plasterRecipe() {
    return {
        .name = "plaster", .size_px = 256, .tile_m = 2.0F, .orm = false, .at = [](glm::vec2 uv) {
            const float cloud = fractalNoise(uv * 4.0F, 4, 4, 310);
            const float trowel = fractalNoise(glm::vec2(uv.x * 6.0F, uv.y * 12.0F), 6, 3, 320);
            const float crack = std::abs(fractalNoise(uv * 4.0F, 4, 4, 330));
            const float line = 1.0F - ramp(0.0F, 0.012F, crack);
            Texel texel;
            texel.color = blend(rgb(0xe9dcc2), rgb(0xd8b892), ramp(-0.3F, 0.7F, cloud));
            texel.color = blend(texel.color, rgb(0xa98d68), 0.35F * line);
            texel.height_m = 0.003F * trowel + 0.003F * cloud - 0.003F * line;
            return texel;
        }};
}

Recipe pavonazzettoRecipe() {
    return marbleRecipe("pavonazzetto", {.ground = rgb(0xeee6da),
                                         .cloud = rgb(0xd9cdbf),
                                         .vein = rgb(0x77606c),
                                         .vein_width = 0.05F,
                                         .vein_strength = 0.7F,
                                         .warp = 0.9F,
                                         .seed = 401});
}

Recipe verdeRecipe() {
    return marbleRecipe("verde", {.ground = rgb(0x1f4a3c),
                                  .cloud = rgb(0x3f7a60),
                                  .vein = rgb(0xa9c9b4),
                                  .vein_width = 0.035F,
                                  .vein_strength = 0.55F,
                                  .warp = 1.6F,
                                  .seed = 501});
}

Recipe rossoRecipe() {
    return {.name = "rosso",
            .size_px = 256,
            .tile_m = 1.0F,
            .normal = false,
            .orm = false,
            .at = [](glm::vec2 uv) {
                const MarbleLook look{.ground = rgb(0x6e2530),
                                      .cloud = rgb(0x8f3b3d),
                                      .vein = rgb(0x4b1620),
                                      .vein_width = 0.10F,
                                      .vein_strength = 0.6F,
                                      .seed = 601};
                Texel texel = marble(uv, look);
                const CellNoise speck = cellNoise(uv * 48.0F, 48, 611);
                const bool pale = (speck.id & 7U) < 3U;
                texel.color = blend(texel.color, pale ? rgb(0xd9a9a0) : rgb(0x50141d),
                                    0.65F * (1.0F - ramp(0.12F, 0.30F, speck.nearest)));
                return texel;
            }};
}

Recipe gialloRecipe() {
    return marbleRecipe("giallo", {.ground = rgb(0xd9a64e),
                                   .cloud = rgb(0xe9c88a),
                                   .vein = rgb(0x9c5a2c),
                                   .vein_width = 0.05F,
                                   .vein_strength = 0.6F,
                                   .warp = 1.4F,
                                   .seed = 701});
}

} // namespace froxel::builtin_scene
