#include "builtin_scene/texture.h"

#include <algorithm>
#include <vector>

namespace froxel::builtin_scene {
namespace {

std::byte quantise(float value) {
    return static_cast<std::byte>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

scene::Image makeImage(const Recipe& recipe, const char* map) {
    scene::Image image;
    image.name = recipe.name + map;
    image.width_px = recipe.size_px;
    image.height_px = recipe.size_px;
    image.rgba8.resize(size_t{4} * recipe.size_px * recipe.size_px);
    return image;
}

void store(scene::Image& image, size_t pixel, glm::vec4 value) {
    for (int channel = 0; channel < 4; ++channel) {
        image.rgba8[pixel * 4 + static_cast<size_t>(channel)] = quantise(value[channel]);
    }
}

// Tangent-space normals of a height field that wraps; +X right, +Y up the image, as glTF says.
scene::Image bakeNormals(const Recipe& recipe, const std::vector<float>& height_m) {
    scene::Image image = makeImage(recipe, "_normal");
    const size_t size = recipe.size_px;
    const float slope_per_m = static_cast<float>(size) / (2.0F * recipe.tile_m);
    const auto at = [&](size_t x, size_t y) { return height_m[(y % size) * size + x % size]; };
    for (size_t y = 0; y < size; ++y) {
        for (size_t x = 0; x < size; ++x) {
            const float dx = (at(x + 1, y) - at(x + size - 1, y)) * slope_per_m;
            const float dy = (at(x, y + 1) - at(x, y + size - 1)) * slope_per_m;
            const glm::vec3 normal = glm::normalize(glm::vec3(-dx, dy, 1.0F));
            store(image, y * size + x, glm::vec4(normal * 0.5F + 0.5F, 1.0F));
        }
    }
    return image;
}

} // namespace

BakedMaps bake(const Recipe& recipe) {
    BakedMaps maps;
    maps.color = makeImage(recipe, "_color");
    if (recipe.orm) {
        maps.orm = makeImage(recipe, "_orm");
    }
    const size_t size = recipe.size_px;
    std::vector<float> height_m(size * size);
    const float step = 1.0F / static_cast<float>(size);
    for (size_t y = 0; y < size; ++y) {
        for (size_t x = 0; x < size; ++x) {
            const size_t pixel = y * size + x;
            const glm::vec2 uv((static_cast<float>(x) + 0.5F) * step,
                               (static_cast<float>(y) + 0.5F) * step);
            const Texel texel = recipe.at(uv);
            store(maps.color, pixel, glm::vec4(texel.color, texel.alpha));
            height_m[pixel] = texel.height_m;
            if (recipe.orm) {
                store(maps.orm, pixel,
                      glm::vec4(texel.occlusion, texel.roughness, texel.metallic, 1.0F));
            }
        }
    }
    if (recipe.normal) {
        maps.normal = bakeNormals(recipe, height_m);
    }
    return maps;
}

} // namespace froxel::builtin_scene
