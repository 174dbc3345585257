#include "render/texel_pack.h"

#include "interface/constants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace froxel::render {

namespace {

// Entries that every device can address in one texel buffer view.
constexpr uint64_t kMostEntries = uint64_t{1} << 26U;

const scene::Image& imageOf(const scene::Scene& scene, const scene::TextureSlot& slot) {
    return scene.images[scene.textures[slot.texture].image];
}

bool packable(const scene::Scene& scene, const scene::TextureSlot& slot) {
    if (slot.texture == scene::kNone) {
        return false;
    }
    const auto& texture = scene.textures[slot.texture];
    const bool plain =
        texture.sampler == scene::kNone || scene.samplers[texture.sampler] == scene::Sampler{};
    const auto& image = imageOf(scene, slot);
    return plain && std::has_single_bit(image.width_px) && std::has_single_bit(image.height_px) &&
           uint64_t{image.width_px} * image.height_px <= kMostEntries / 2;
}

bool alike(const scene::Scene& scene, const scene::TextureSlot& a, const scene::TextureSlot& b) {
    const auto& x = imageOf(scene, a);
    const auto& y = imageOf(scene, b);
    return x.width_px == y.width_px && x.height_px == y.height_px && a.texcoord == b.texcoord &&
           a.offset == b.offset && a.rotation_rad == b.rotation_rad && a.scale == b.scale;
}

bool usesAlpha(const scene::Material& material) {
    return material.alpha_mode != scene::AlphaMode::kOpaque;
}

// IEC 61966-2-1.
std::array<float, 256> linearOfSrgb() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const double c = static_cast<double>(i) / 255;
        table[i] =
            static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

// What is averaged from level to level; colours in linear light.
struct Texel {
    glm::vec3 color{0};
    glm::vec4 rest{0};
};

uint32_t byteOf(float value) {
    return static_cast<uint32_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

uint32_t wordOf(const glm::vec4& v) {
    return byteOf(v.x) | byteOf(v.y) << 8U | byteOf(v.z) << 16U | byteOf(v.w) << 24U;
}

uint32_t wordOf(const glm::vec3& linear) {
    const glm::vec3 scaled = glm::sqrt(linear) * glm::vec3(2047, 2047, 1023) + 0.5F;
    return static_cast<uint32_t>(scaled.x) | static_cast<uint32_t>(scaled.y) << 11U |
           static_cast<uint32_t>(scaled.z) << 22U;
}

// The blue byte that all texels share.
std::optional<uint8_t> constantMetalness(const scene::Image& image) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(image.rgba8.data());
    for (size_t i = 2; i < image.rgba8.size(); i += 4) {
        if (bytes[i] != bytes[2]) {
            return std::nullopt;
        }
    }
    return bytes[2];
}

std::vector<Texel>
readTexels(const scene::Scene& scene, const scene::Material& material, const PackPlan& plan) {
    static const std::array<float, 256> kLinear = linearOfSrgb();
    const auto& extent = imageOf(scene, packSlot(material, plan));
    std::vector<Texel> texels(size_t{extent.width_px} * extent.height_px);
    const auto each = [&](const scene::TextureSlot& slot, auto use) {
        const auto* bytes = reinterpret_cast<const uint8_t*>(imageOf(scene, slot).rgba8.data());
        for (size_t i = 0; i < texels.size(); ++i) {
            use(texels[i], bytes + i * 4);
        }
    };
    const auto share = [](uint8_t byte) { return static_cast<float>(byte) / 255.0F; };
    if (plan.color) {
        each(material.base_color_texture, [&](Texel& t, const uint8_t* rgba) {
            t.color = {kLinear[rgba[0]], kLinear[rgba[1]], kLinear[rgba[2]]};
            t.rest.w = share(rgba[3]);
        });
    }
    if (plan.normal) {
        each(material.normal_texture, [&](Texel& t, const uint8_t* rgba) {
            t.rest = {share(rgba[0]), share(rgba[1]), share(rgba[2]), t.rest.w};
        });
    }
    if (plan.roughness) {
        each(material.metallic_roughness_texture,
             [&](Texel& t, const uint8_t* rgba) { t.rest.w = share(rgba[1]); });
    }
    return texels;
}

std::vector<Texel> halve(const std::vector<Texel>& from, glm::uvec2 size) {
    std::vector<Texel> to;
    to.reserve(from.size() / 4);
    for (uint32_t y = 0; y < size.y; y += 2) {
        for (uint32_t x = 0; x < size.x; x += 2) {
            const Texel* row = &from[size_t{y} * size.x + x];
            const Texel* below = row + size.x;
            to.push_back({(row[0].color + row[1].color + below[0].color + below[1].color) * 0.25F,
                          (row[0].rest + row[1].rest + below[0].rest + below[1].rest) * 0.25F});
        }
    }
    return to;
}

void appendLevel(const std::vector<Texel>& texels, bool pair, std::vector<uint32_t>& words) {
    for (const Texel& t : texels) {
        words.push_back(wordOf(t.color));
        if (pair) {
            words.push_back(wordOf(t.rest));
        }
    }
}

} // namespace

uint32_t PackPlan::flags() const {
    return (color ? io::kMaterialPackedColor : 0U) | (normal ? io::kMaterialPackedNormal : 0U) |
           (roughness ? io::kMaterialPackedRoughness : 0U) |
           (pair() ? io::kMaterialPackedPair : 0U);
}

PackPlan planPack(const scene::Scene& scene, const scene::Material& material) {
    PackPlan plan;
    const scene::TextureSlot* first = nullptr;
    const auto fits = [&](const scene::TextureSlot& slot) {
        if (!packable(scene, slot) || (first != nullptr && !alike(scene, *first, slot))) {
            return false;
        }
        first = first != nullptr ? first : &slot;
        return true;
    };
    plan.color = fits(material.base_color_texture);
    plan.alpha = plan.color && usesAlpha(material);
    if (material.unlit) {
        return plan;
    }
    plan.normal = fits(material.normal_texture);
    // Roughness and alpha share a byte.
    const auto& roughness = material.metallic_roughness_texture;
    plan.roughness = !plan.alpha && packable(scene, roughness) &&
                     constantMetalness(imageOf(scene, roughness)) && fits(roughness);
    return plan;
}

const scene::TextureSlot& packSlot(const scene::Material& material, const PackPlan& plan) {
    return plan.color    ? material.base_color_texture
           : plan.normal ? material.normal_texture
                         : material.metallic_roughness_texture;
}

float packedMetalness(const scene::Scene& scene, const scene::Material& material) {
    const auto byte = constantMetalness(imageOf(scene, material.metallic_roughness_texture));
    return material.metallic * static_cast<float>(byte.value_or(255)) / 255.0F;
}

TexelPack
packTexels(const scene::Scene& scene, const scene::Material& material, const PackPlan& plan) {
    const auto& image = imageOf(scene, packSlot(material, plan));
    glm::uvec2 size(image.width_px, image.height_px);
    TexelPack pack;
    pack.log2_size = {std::countr_zero(size.x), std::countr_zero(size.y)};
    pack.last_level = std::min(pack.log2_size.x, pack.log2_size.y);
    pack.words.reserve((size_t{size.x} * size.y * 4 / 3 + 1) * (plan.pair() ? 2 : 1));
    auto texels = readTexels(scene, material, plan);
    for (uint32_t level = 0; level <= pack.last_level; ++level) {
        appendLevel(texels, plan.pair(), pack.words);
        if (level < pack.last_level) {
            texels = halve(texels, size);
            size /= 2U;
        }
    }
    return pack;
}

} // namespace froxel::render
