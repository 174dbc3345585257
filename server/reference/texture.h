// Textures filtered in double.
#pragma once

#include "core/visibility.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace froxel::reference {

// Texture coordinates at a point and their change to the next pixel right and down.
struct Footprint {
    glm::dvec2 uv{0};
    glm::dvec2 dx{0};
    glm::dvec2 dy{0};
};

// An image and its mip levels. A level that the image does not give halves the one before, rounded
// down, each texel being that one's bilinear sample at its centre: the box of four texels where
// sizes are even. Averaged in linear light, never rounded to eight bits.
class MipChain {
  public:
    // Keeps a reference to the image. srgb: its colours are encoded by IEC 61966-2-1, alpha is not.
    MipChain(const scene::Image& image, bool srgb);

    // The filter of Vulkan 1.3, 16.6 to 16.9, without its leave to approximate but for `filter`.
    // What a footprint is to an anisotropic sampler Vulkan leaves open: it is what an H200 makes of
    // it, as measured (tests/render/texture_filter_test.cpp).
    [[nodiscard]] glm::dvec4 sample(const scene::Sampler& sampler,
                                    const Footprint& footprint,
                                    const TextureFilter& filter = {}) const;

    [[nodiscard]] size_t levelCount() const { return levels_.size() + 1; }
    // Linear RGBA; x and y inside the level.
    [[nodiscard]] glm::dvec4 texel(size_t level, uint32_t x, uint32_t y) const;
    [[nodiscard]] glm::uvec2 size(size_t level) const;

  private:
    struct Level {
        uint32_t width_px = 0;
        uint32_t height_px = 0;
        std::vector<glm::vec4> texels; // the fp32 rounding is far below that of eight bits
    };

    [[nodiscard]] Level given(size_t level) const;
    [[nodiscard]] Level halve(size_t level) const;
    [[nodiscard]] glm::dvec4 sampleLevel(const scene::Sampler& sampler,
                                         size_t level,
                                         bool linear,
                                         const glm::dvec2& uv,
                                         double weight_step = 0) const;
    [[nodiscard]] glm::dvec4 sampleLod(const scene::Sampler& sampler,
                                       double lod,
                                       const glm::dvec2& uv,
                                       const TextureFilter& filter) const;

    const scene::Image& image_;
    bool srgb_;
    std::vector<Level> levels_; // from level 1 on
};

// IEC 61966-2-1: an encoded colour in [0, 1] to linear light.
[[nodiscard]] double decodeSrgb(double encoded);

} // namespace froxel::reference
