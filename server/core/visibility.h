// What a device says each pixel shows.
#pragma once

#include <cstdint>
#include <vector>

namespace froxel {

// One pixel's solid surface: which triangle of which placed mesh covers the pixel's centre.
struct VisibleTriangle {
    static constexpr uint32_t kNothing = 0xFFFFFFFF;
    uint32_t instance = kNothing; // index into scene::Scene::instances
    uint32_t primitive = 0;       // of the instance's mesh
    uint32_t triangle = 0;        // of the primitive: its indices 3 i, 3 i + 1, 3 i + 2
    bool operator==(const VisibleTriangle&) const = default;
};

// How the device filters textures, as it states it.
struct TextureFilter {
    double max_anisotropy = 1; // of samplers that filter linearly between mip levels; 1: isotropic
    double weight_step = 0;    // weights of a texel are multiples of it; 0: exact
    double level_step = 0;     // levels of detail likewise
};

struct Visibility {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<VisibleTriangle> pixels; // [height][width], top row first
    std::vector<float> depths;           // theirs, as the device has it: reversed, 0 where empty
    TextureFilter filter{};
};

} // namespace froxel
