#include "reference/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::reference {
namespace {

double decodeByte(std::byte value, bool srgb) {
    static const auto table = [] {
        std::array<double, 256> linear{};
        for (size_t i = 0; i < linear.size(); ++i) {
            linear[i] = decodeSrgb(static_cast<double>(i) / 255);
        }
        return linear;
    }();
    const auto i = std::to_integer<size_t>(value);
    return srgb ? table[i] : static_cast<double>(i) / 255;
}

glm::dvec4 decodeTexel(const std::byte* rgba, bool srgb) {
    return {decodeByte(rgba[0], srgb), decodeByte(rgba[1], srgb), decodeByte(rgba[2], srgb),
            decodeByte(rgba[3], false)};
}

// A texel's index inside [0, size) for any whole number; 0 for what is none.
uint32_t wrapped(scene::Wrap wrap, double index, uint32_t size) {
    const double n = size;
    double i = index;
    switch (wrap) {
    case scene::Wrap::kRepeat:
        i -= std::floor(i / n) * n;
        break;
    case scene::Wrap::kMirroredRepeat:
        i -= std::floor(i / (2 * n)) * 2 * n;
        i = i < n ? i : 2 * n - 1 - i;
        break;
    case scene::Wrap::kClampToEdge:
        break;
    }
    return i > 0 ? static_cast<uint32_t>(std::min(i, n - 1)) : 0;
}

} // namespace

double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

MipChain::MipChain(const scene::Image& image, bool srgb) : image_(image), srgb_(srgb) {
    while (size(levels_.size()) != glm::uvec2(1)) {
        const size_t last = levels_.size();
        levels_.push_back(last < image.mips.size() ? given(last + 1) : halve(last));
    }
}

glm::uvec2 MipChain::size(size_t level) const {
    return level == 0 ? glm::uvec2(image_.width_px, image_.height_px)
                      : glm::uvec2(levels_[level - 1].width_px, levels_[level - 1].height_px);
}

glm::dvec4 MipChain::texel(size_t level, uint32_t x, uint32_t y) const {
    if (level > 0) {
        const Level& of = levels_[level - 1];
        return glm::dvec4(of.texels[size_t{y} * of.width_px + x]);
    }
    return decodeTexel(&image_.rgba8[4 * (size_t{y} * image_.width_px + x)], srgb_);
}

MipChain::Level MipChain::given(size_t level) const {
    const std::vector<std::byte>& rgba8 = image_.mips[level - 1];
    Level out{std::max(image_.width_px >> level, 1U), std::max(image_.height_px >> level, 1U), {}};
    for (size_t i = 0; i < rgba8.size(); i += 4) {
        out.texels.emplace_back(decodeTexel(&rgba8[i], srgb_));
    }
    return out;
}

MipChain::Level MipChain::halve(size_t level) const {
    const glm::uvec2 from = size(level);
    const glm::uvec2 to = glm::max(from / 2U, glm::uvec2(1));
    Level half{to.x, to.y, std::vector<glm::vec4>(size_t{to.x} * to.y)};
    const scene::Sampler clamp{.wrap_u = scene::Wrap::kClampToEdge,
                               .wrap_v = scene::Wrap::kClampToEdge};
    for (uint32_t y = 0; y < to.y; ++y) {
        for (uint32_t x = 0; x < to.x; ++x) {
            const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) / glm::dvec2(to);
            half.texels[size_t{y} * to.x + x] = glm::vec4(sampleLevel(clamp, level, true, uv));
        }
    }
    return half;
}

glm::dvec4 MipChain::sampleLevel(const scene::Sampler& sampler,
                                 size_t level,
                                 bool linear,
                                 const glm::dvec2& uv) const {
    const glm::uvec2 extent = size(level);
    const glm::dvec2 at = uv * glm::dvec2(extent);
    const auto fetch = [&](double x, double y) {
        return texel(level, wrapped(sampler.wrap_u, x, extent.x),
                     wrapped(sampler.wrap_v, y, extent.y));
    };
    if (!linear) {
        return fetch(std::floor(at.x), std::floor(at.y));
    }
    const glm::dvec2 low = glm::floor(at - 0.5);
    const glm::dvec2 w = at - 0.5 - low;
    return (fetch(low.x, low.y) * (1 - w.x) + fetch(low.x + 1, low.y) * w.x) * (1 - w.y) +
           (fetch(low.x, low.y + 1) * (1 - w.x) + fetch(low.x + 1, low.y + 1) * w.x) * w.y;
}

glm::dvec4
MipChain::sampleLod(const scene::Sampler& sampler, double lod, const glm::dvec2& uv) const {
    const double top = sampler.mipmapped ? static_cast<double>(levelCount() - 1) : 0.0;
    const bool magnified = !(lod > 0);
    const bool linear = (magnified ? sampler.mag : sampler.min) == scene::Filter::kLinear;
    const double level = std::clamp(magnified ? 0.0 : lod, 0.0, top);
    if (sampler.mip == scene::Filter::kNearest) {
        const double nearest = std::max(0.0, std::ceil(level + 0.5) - 1); // ties: the sharper one
        return sampleLevel(sampler, static_cast<size_t>(nearest), linear, uv);
    }
    const double below = std::floor(level);
    const double share = level - below;
    const auto first = static_cast<size_t>(below);
    const glm::dvec4 sharp = sampleLevel(sampler, first, linear, uv);
    return share > 0 ? glm::mix(sharp, sampleLevel(sampler, first + 1, linear, uv), share) : sharp;
}

glm::dvec4 MipChain::sample(const scene::Sampler& sampler,
                            const Footprint& footprint,
                            double max_anisotropy) const {
    const glm::dvec2 base(size(0));
    const double across = glm::length(footprint.dx * base);
    const double down = glm::length(footprint.dy * base);
    const double longest = std::max(across, down);
    const bool filtered = sampler.mipmapped && sampler.min == scene::Filter::kLinear;
    const double shortest = std::max(std::min(across, down), longest * 1e-6);
    const double ratio =
        filtered && longest > 0 ? std::min(longest / shortest, max_anisotropy) : 1.0;
    const double taps = std::ceil(ratio);
    const double lod = longest > 0 ? std::log2(longest / taps) : -1.0;
    if (taps <= 1) {
        return sampleLod(sampler, lod, footprint.uv);
    }
    const glm::dvec2 along = across >= down ? footprint.dx : footprint.dy;
    glm::dvec4 sum(0);
    for (double i = 1; i <= taps; ++i) {
        sum += sampleLod(sampler, lod, footprint.uv + along * (i / (taps + 1) - 0.5));
    }
    return sum / taps;
}

} // namespace froxel::reference
