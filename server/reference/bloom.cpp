#include "reference/bloom.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace froxel::reference {
namespace {

using Picture = std::vector<glm::dvec3>;

std::vector<double> gaussian(double sigma_px) {
    std::vector<double> weights(static_cast<size_t>(std::ceil(6 * sigma_px)) + 1);
    double sum = 0;
    for (size_t k = 0; k < weights.size(); ++k) {
        const double x = static_cast<double>(k) / sigma_px;
        weights[k] = std::exp(-0.5 * x * x);
        sum += k == 0 ? weights[k] : 2 * weights[k];
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

size_t mirrored(ptrdiff_t at, ptrdiff_t size) {
    const ptrdiff_t period = 2 * size;
    at = (at % period + period) % period;
    return static_cast<size_t>(std::min(at, period - 1 - at));
}

// Lines of `count` pixels `stride` apart; lines start `step` apart.
void blurLines(Picture& picture,
               const std::vector<double>& weights,
               size_t lines,
               size_t step,
               size_t count,
               size_t stride) {
    std::vector<glm::dvec3> line(count);
    for (size_t i = 0; i < lines; ++i) {
        for (size_t at = 0; at < count; ++at) {
            line[at] = picture[i * step + at * stride];
        }
        for (size_t at = 0; at < count; ++at) {
            glm::dvec3 sum = weights[0] * line[at];
            for (size_t k = 1; k < weights.size(); ++k) {
                const auto place = static_cast<ptrdiff_t>(at);
                const auto away = static_cast<ptrdiff_t>(k);
                const auto size = static_cast<ptrdiff_t>(count);
                sum += weights[k] *
                       (line[mirrored(place - away, size)] + line[mirrored(place + away, size)]);
            }
            picture[i * step + at * stride] = sum;
        }
    }
}

} // namespace

glm::dvec3 brightPart(const glm::dvec3& color, double threshold, double knee) {
    const double peak = std::max({color.x, color.y, color.z});
    if (!(peak > 0)) {
        return glm::dvec3(0);
    }
    const double over = std::clamp(peak - threshold + knee, 0.0, 2 * knee);
    const double soft = knee > 0 ? over * over / (4 * knee) : 0.0;
    return color * (std::max({soft, peak - threshold, 0.0}) / peak);
}

LinearImage spread(const LinearImage& picture, const settings::Bloom& bloom, double exposure) {
    const double threshold = static_cast<double>(bloom.threshold) / exposure;
    const double knee = threshold * static_cast<double>(bloom.knee);
    const size_t width = picture.width_px;
    const size_t height = picture.height_px;
    Picture bright(width * height);
    for (size_t i = 0; i < bright.size(); ++i) {
        const float* rgb = &picture.rgb[3 * i];
        bright[i] = brightPart({rgb[0], rgb[1], rgb[2]}, threshold, knee);
    }
    Picture spread = bright;
    const auto weights =
        gaussian(static_cast<double>(bloom.radius) * static_cast<double>(std::min(width, height)));
    blurLines(spread, weights, height, width, width, 1);
    blurLines(spread, weights, width, 1, height, width);
    LinearImage result = picture;
    for (size_t i = 0; i < bright.size(); ++i) {
        const glm::dvec3 moved = static_cast<double>(bloom.strength) * (spread[i] - bright[i]);
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            float& value = result.rgb[3 * i + static_cast<size_t>(channel)];
            value = static_cast<float>(static_cast<double>(value) + moved[channel]);
        }
    }
    return result;
}

} // namespace froxel::reference
