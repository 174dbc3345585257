// Procedural surfaces baked to glTF's texture maps.
#pragma once

#include "core/math.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <string>

namespace froxel::builtin_scene {

// What a surface is at one point. Colours are sRGB-encoded as a painter sees them, so that baking
// needs no transfer function and gives the same bytes everywhere.
struct Texel {
    glm::vec3 color{1, 1, 1};
    float alpha = 1;
    float height_m = 0;
    float roughness = 1;
    float metallic = 0;
    float occlusion = 1;
};

// A square tile of a surface. `at` takes uv in [0, 1), v down, and must repeat at the borders.
struct Recipe {
    std::string name;
    uint32_t size_px = 512;
    float tile_m = 1; // edge length of the tile in the world
    bool normal = true;
    bool orm = true; // occlusion, roughness, metallic in R, G, B
    std::function<Texel(glm::vec2 uv)> at;
};

struct BakedMaps {
    scene::Image color;
    scene::Image normal; // empty unless the recipe asks for it
    scene::Image orm;    // likewise
};

// Pure: may run on any thread.
[[nodiscard]] BakedMaps bake(const Recipe& recipe);

} // namespace froxel::builtin_scene
