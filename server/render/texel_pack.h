// A material's textures interleaved into one buffer, for devices that sample in software: the
// shader filters colour, normal, roughness and metalness with one set of addresses and weights
// (shaders/lib/texel_pack.glsl).
//
// A texel's words: 0 = base colour, gamma 2 in 11, 11 and 10 bits: linear = (number / greatest)^2,
// a quarter of a step of 8-bit sRGB at worst; 1 = normal (three bytes as stored), then alpha where
// the material has a use for it, else roughness. Without normal, alpha and roughness there is only
// word 0. Levels follow each other, row by row, each half as wide and as high, until a side is 1.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace froxel::render {

// Which slots a material's pack replaces.
struct PackPlan {
    bool color = false;
    bool normal = false;
    bool alpha = false;
    bool roughness = false; // its metalness is the same all over: packedMetalness()
    [[nodiscard]] bool any() const { return color || normal || roughness; }
    [[nodiscard]] bool pair() const { return normal || alpha || roughness; }
    // As bits of io::kMaterialPacked*.
    [[nodiscard]] uint32_t flags() const;
    auto operator<=>(const PackPlan&) const = default;
};

// Slots of one size (powers of 2), one sampler (trilinear, repeating) and one set of texture
// coordinates go together; what does not match the first of them keeps its sampler.
[[nodiscard]] PackPlan planPack(const scene::Scene& scene, const scene::Material& material);

// The slot that gives the pack its texture coordinates.
[[nodiscard]] const scene::TextureSlot& packSlot(const scene::Material& material,
                                                 const PackPlan& plan);

// The metalness of a material whose roughness is packed.
[[nodiscard]] float packedMetalness(const scene::Scene& scene, const scene::Material& material);

struct TexelPack {
    glm::uvec2 log2_size{0};
    uint32_t last_level = 0;
    std::vector<uint32_t> words;
};

[[nodiscard]] TexelPack
packTexels(const scene::Scene& scene, const scene::Material& material, const PackPlan& plan);

} // namespace froxel::render
