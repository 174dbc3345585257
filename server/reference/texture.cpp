#include "reference/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

double stepped(double value, double step) {
    return step > 0 ? std::round(value / step) * step : value;
}

// A footprint as the sampler sees it: the longer axis, and the width of what it covers across it.
struct Axes {
    glm::dvec2 along_uv{0};
    double along = 0; // texels of level 0
    double across = 0;
};

// At most 6 % from Euclid's.
double lengthOf(const glm::dvec2& v) {
    const glm::dvec2 a = glm::abs(v);
    return std::max(a.x, a.y) + 11.0 / 32 * std::min(a.x, a.y);
}

// The longest of both changes and of the diagonals between them, whose half widths are those of
// the ellipse where both are equally long.
Axes axesOf(const Footprint& footprint, const glm::dvec2& texels) {
    constexpr double kHalfDiagonal = 11.0 / 16;
    Axes axes;
    const auto offer = [&](const glm::dvec2& uv, double scale, double uv_scale) {
        const double length = lengthOf(uv * texels) * scale;
        if (length > axes.along) {
            axes.along = length;
            axes.along_uv = uv * uv_scale;
        }
    };
    offer(footprint.dx, 1, 1);
    offer(footprint.dy, 1, 1);
    offer(footprint.dx + footprint.dy, kHalfDiagonal, std::numbers::sqrt2 / 2);
    offer(footprint.dx - footprint.dy, kHalfDiagonal, std::numbers::sqrt2 / 2);
    const glm::dvec2 a = footprint.dx * texels;
    const glm::dvec2 b = footprint.dy * texels;
    if (axes.along > 0) {
        axes.across = std::min(axes.along, std::abs(a.x * b.y - a.y * b.x) / axes.along);
    }
    return axes;
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
    const std::span<const std::byte> rgba8 = image_.mips[level - 1];
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
                                 const glm::dvec2& uv,
                                 double weight_step) const {
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
    const glm::dvec2 share = at - 0.5 - low;
    const glm::dvec2 w(stepped(share.x, weight_step), stepped(share.y, weight_step));
    return (fetch(low.x, low.y) * (1 - w.x) + fetch(low.x + 1, low.y) * w.x) * (1 - w.y) +
           (fetch(low.x, low.y + 1) * (1 - w.x) + fetch(low.x + 1, low.y + 1) * w.x) * w.y;
}

glm::dvec4 MipChain::sampleLod(const scene::Sampler& sampler,
                               double lod,
                               const glm::dvec2& uv,
                               const TextureFilter& filter) const {
    const double top = sampler.mipmapped ? static_cast<double>(levelCount() - 1) : 0.0;
    const bool magnified = !(lod > 0);
    const bool linear = (magnified ? sampler.mag : sampler.min) == scene::Filter::kLinear;
    const double level = std::clamp(magnified ? 0.0 : stepped(lod, filter.level_step), 0.0, top);
    const auto sampled = [&](double of) {
        return sampleLevel(sampler, static_cast<size_t>(of), linear, uv, filter.weight_step);
    };
    if (sampler.mip == scene::Filter::kNearest) {
        return sampled(std::max(0.0, std::ceil(level + 0.5) - 1)); // ties: the sharper one
    }
    const double below = std::floor(level);
    const double share = level - below;
    const glm::dvec4 sharp = sampled(below);
    return share > 0 ? glm::mix(sharp, sampled(below + 1), share) : sharp;
}

glm::dvec4 MipChain::sample(const scene::Sampler& sampler,
                            const Footprint& footprint,
                            const TextureFilter& filter) const {
    const glm::dvec2 base(size(0));
    const bool by_area =
        filter.max_anisotropy > 1 && sampler.mipmapped && sampler.min == scene::Filter::kLinear;
    if (!by_area) {
        const double widest =
            std::max(glm::length(footprint.dx * base), glm::length(footprint.dy * base));
        return sampleLod(sampler, std::log2(widest), footprint.uv, filter);
    }
    const Axes axes = axesOf(footprint, base);
    const double across = std::max(axes.across, axes.along / filter.max_anisotropy);
    const double lod = std::log2(across);
    // No more of them than there are texels.
    const double ratio = axes.along / std::max(across, 1.0);
    if (!(ratio > 1)) {
        return sampleLod(sampler, lod, footprint.uv, filter);
    }
    glm::dvec4 sum(0);
    const glm::dvec2 step = axes.along_uv / ratio;
    const auto add = [&](double steps, double weight) {
        sum += weight * (sampleLod(sampler, lod, footprint.uv + steps * step, filter) +
                         sampleLod(sampler, lod, footprint.uv - steps * step, filter));
    };
    // Pairs of taps, a step apart and each for a step; the last two are for what is left.
    const double whole = std::ceil(ratio / 2) - 1;
    for (double i = 0; i < whole; ++i) {
        add(i + 0.5, 1 / ratio);
    }
    add(whole > 0 ? whole + 0.5 : 1 - 1 / ratio, 0.5 - whole / ratio);
    return sum;
}

} // namespace froxel::reference
