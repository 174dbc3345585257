#include "builtin_scene/noise.h"
#include "builtin_scene/recipes.h"
#include "builtin_scene/shade.h"

#include <algorithm>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

constexpr glm::vec3 kCream = rgb(0xe6dcc8);
constexpr glm::vec3 kPorphyry = rgb(0x7a2b33);
constexpr glm::vec3 kSerpentine = rgb(0x2c5a47);
constexpr glm::vec3 kHoney = rgb(0xd3a356);
constexpr glm::vec3 kSlate = rgb(0x4a4f57);

struct Inlay {
    glm::vec3 color;
    float edge_m; // distance to the joint, a metre to the cell
};

// A disc in a square: porphyry or serpentine with a honey ring.
Inlay discCell(glm::vec2 p, bool red) {
    const float r = glm::length(p);
    const float side = std::max(std::abs(p.x), std::abs(p.y));
    if (r < 0.27F) {
        return {red ? kPorphyry : kSerpentine, 0.27F - r};
    }
    if (r < 0.34F) {
        return {kHoney, std::min(r - 0.27F, 0.34F - r)};
    }
    if (side < 0.42F) {
        return {kCream, std::min(r - 0.34F, 0.42F - side)};
    }
    return {red ? kSerpentine : kSlate, std::min(side - 0.42F, 0.5F - side)};
}

// A square stood on its corner, with triangles in the corners and a small square at its heart.
Inlay lozengeCell(glm::vec2 p) {
    const float diamond = std::abs(p.x) + std::abs(p.y);
    const float side = std::max(std::abs(p.x), std::abs(p.y));
    constexpr float kSlope = 0.7071F;
    if (side < 0.13F) {
        return {kPorphyry, 0.13F - side};
    }
    if (diamond < 0.42F) {
        return {kCream, std::min((0.42F - diamond) * kSlope, side - 0.13F)};
    }
    if (side < 0.42F) {
        return {p.x * p.y > 0 ? kHoney : kSerpentine,
                std::min({(diamond - 0.42F) * kSlope, 0.42F - side,
                          std::min(std::abs(p.x), std::abs(p.y))})};
    }
    return {kCream, std::min(side - 0.42F, 0.5F - side)};
}

} // namespace

// Two metres square, four cells of a metre.
Recipe inlayRecipe() {
    return {.name = "inlay", .size_px = 512, .tile_m = 2.0F, .orm = false, .at = [](glm::vec2 uv) {
                const glm::vec2 cell = glm::floor(uv * 2.0F);
                const glm::vec2 p = uv * 2.0F - cell - 0.5F;
                const bool even = cell.x == cell.y;
                const Inlay inlay = even ? discCell(p, cell.x == 0) : lozengeCell(p);
                const float cloud = fractalNoise(uv * 8.0F + inlay.color.x * 7.0F, 8, 4, 810);
                const float vein =
                    1.0F - ramp(0.0F, 0.05F, std::abs(fractalNoise(uv * 8.0F, 8, 4, 820)));
                const float joint = 1.0F - ramp(0.0025F, 0.006F, inlay.edge_m);
                const float wear = fractalNoise(uv * 4.0F, 4, 4, 830);
                Texel texel;
                texel.color = inlay.color * (1.0F + 0.16F * cloud);
                texel.color = blend(texel.color, texel.color * 0.72F + 0.05F, 0.5F * vein);
                texel.color = blend(texel.color, rgb(0x6d6252), 0.8F * joint);
                texel.height_m = 0.0022F * ramp(0.0F, 0.010F, inlay.edge_m) + 0.0006F * wear;
                return texel;
            }};
}

// Opus spicatum: bricks of 0.25 x 0.125 m; the pattern repeats every four cells of 0.125 m.
Recipe herringboneRecipe() {
    return {.name = "herringbone",
            .size_px = 512,
            .tile_m = 1.0F,
            .orm = false,
            .at = [](glm::vec2 uv) {
                const glm::vec2 p = uv * 8.0F;
                const glm::vec2 cell = glm::floor(p);
                const glm::vec2 f = p - cell;
                const auto x = static_cast<int32_t>(cell.x);
                const auto y = static_cast<int32_t>(cell.y);
                // Along a diagonal staircase two cells lie flat, the next two stand.
                const int32_t phase = ((x - y) % 4 + 4) % 4;
                const bool flat = phase < 2;
                const int32_t half = flat ? phase : 3 - phase;
                const glm::vec2 brick = flat ? glm::vec2(f.x + static_cast<float>(half), f.y)
                                             : glm::vec2(f.x, f.y + static_cast<float>(half));
                const glm::vec2 size = flat ? glm::vec2(2, 1) : glm::vec2(1, 2);
                const int32_t id_x = ((flat ? x - half : x) % 8 + 8) % 8;
                const int32_t id_y = ((flat ? y : y - half) % 8 + 8) % 8;
                const glm::vec2 edges = glm::min(brick, size - brick);
                const float edge_m = std::min(edges.x, edges.y) * 0.125F +
                                     0.0015F * fractalNoise(uv * 16.0F, 16, 2, 905);
                const float joint = 1.0F - ramp(0.003F, 0.007F, edge_m);
                const float tone = randomAt(id_x, id_y, 910);
                const float kiln = randomAt(id_x, id_y, 911);
                const float grain = fractalNoise(uv * 32.0F, 32, 3, 920);
                const float tilt = (randomAt(id_x, id_y, 912) - 0.5F) * (brick.x - 0.5F) +
                                   (randomAt(id_x, id_y, 913) - 0.5F) * (brick.y - 0.5F);
                Texel texel;
                texel.color = blend(rgb(0xa65f41), rgb(0xc58a5c), tone);
                texel.color = blend(texel.color, rgb(0x7d4536), ramp(0.7F, 1.0F, kiln));
                texel.color *= 1.0F + 0.10F * grain;
                texel.color = blend(texel.color, rgb(0xb5a384), 0.85F * joint);
                texel.height_m =
                    0.004F * ramp(0.0F, 0.012F, edge_m) + 0.0006F * grain + 0.0012F * tilt;
                return texel;
            }};
}

// Gold tesserae of about 16 mm, each tilted a little, as mosaicists set them to catch light.
Recipe mosaicRecipe() {
    return {.name = "mosaic", .size_px = 512, .tile_m = 0.5F, .at = [](glm::vec2 uv) {
                const glm::vec2 bend(0.35F * fractalNoise(uv * 4.0F, 4, 2, 1001),
                                     0.35F * fractalNoise(uv * 4.0F, 4, 2, 1002));
                const glm::vec2 p = uv * 32.0F + bend;
                const glm::vec2 cell = glm::floor(p);
                const glm::vec2 f = p - cell - 0.5F;
                const auto x = (static_cast<int32_t>(cell.x) + 32) % 32;
                const auto y = (static_cast<int32_t>(cell.y) + 32) % 32;
                const float edge = 0.5F - std::max(std::abs(f.x), std::abs(f.y));
                const float joint = 1.0F - ramp(0.04F, 0.10F, edge);
                const float tone = randomAt(x, y, 1010);
                const float rare = randomAt(x, y, 1011);
                const glm::vec2 tilt(randomAt(x, y, 1012) - 0.5F, randomAt(x, y, 1013) - 0.5F);
                Texel texel;
                texel.color = blend(rgb(0xc98f33), rgb(0xf5cf74), tone);
                texel.color = rare > 0.95F ? rgb(0xa65a2b) : texel.color;
                texel.color = blend(texel.color, rgb(0x6b5330), joint);
                texel.height_m = 0.0028F * glm::dot(tilt, f) * (1.0F - joint) - 0.0006F * joint;
                texel.metallic = 0.92F * (1.0F - joint);
                texel.roughness = 0.26F + 0.18F * randomAt(x, y, 1014) + 0.45F * joint;
                texel.occlusion = 1.0F - 0.3F * joint;
                return texel;
            }};
}

// One eight-pointed gold star on lapis; a tile a coffer.
Recipe starsRecipe() {
    return {.name = "stars", .size_px = 256, .tile_m = 0.7F, .at = [](glm::vec2 uv) {
                const glm::vec2 p = glm::abs(uv - 0.5F);
                const glm::vec2 q((p.x + p.y) * 0.7071F, std::abs(p.x - p.y) * 0.7071F);
                const auto spike = [](glm::vec2 s, float reach) {
                    const float major = std::max(s.x, s.y);
                    const float minor = std::min(s.x, s.y);
                    return minor * 3.2F + major - reach;
                };
                const float r = glm::length(p);
                const float star = std::min({spike(p, 0.40F), spike(q, 0.28F), r - 0.13F});
                const float gold = 1.0F - ramp(-0.006F, 0.006F, star);
                const float ring = 1.0F - ramp(0.006F, 0.012F, std::abs(r - 0.455F));
                const float cloud = fractalNoise(uv * 4.0F, 4, 4, 1110);
                const float gilt = std::max(gold, ring);
                Texel texel;
                texel.color = blend(rgb(0x1c2f66), rgb(0x35549b), ramp(-0.5F, 0.6F, cloud));
                texel.color = blend(texel.color, rgb(0xf0c566), gilt);
                texel.height_m = 0.012F * (1.0F - ramp(-0.06F, 0.0F, star)) + 0.002F * cloud;
                texel.metallic = gilt;
                texel.roughness = 0.75F - 0.42F * gilt;
                return texel;
            }};
}

} // namespace froxel::builtin_scene
