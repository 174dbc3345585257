#include "environment/prefiltered.h"

#include "core/parallel.h"
#include "environment/glossy.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace froxel::environment {
namespace {

constexpr uint32_t kFaces = 6;

glm::dvec3 texelAt(const CubeLevel& level, const CubePlace& place) {
    const auto index = [&](double at) {
        return std::min(static_cast<uint32_t>(at * level.size_px), level.size_px - 1);
    };
    const size_t row = size_t{place.face} * level.size_px + index(place.y);
    const float* rgb = &level.rgb[(row * level.size_px + index(place.x)) * 3];
    return {rgb[0], rgb[1], rgb[2]};
}

double roughnessOf(size_t level, size_t level_count) {
    return level == 0 ? 0 : std::exp2(-0.5 * static_cast<double>(level_count - 1 - level));
}

glm::dvec3 texelDirection(size_t size_px, size_t index) {
    const size_t row = index / size_px;
    const auto middle = [&](size_t at) {
        return (static_cast<double>(at) + 0.5) / double(size_px);
    };
    return cubeDirection(static_cast<uint32_t>(row / size_px), middle(index % size_px),
                         middle(row % size_px));
}

glm::dvec3
filtered(const Pyramid& pyramid, const glm::dvec3& normal, double roughness, uint32_t samples) {
    // A sample stands for its share of the directions (Krivanek and Colbert 2008, "Real-time
    // Shading with Filtered Importance Sampling").
    glm::dvec3 sum(0);
    double weights = 0;
    eachReflection(
        roughness, samples, [&](const glm::dvec3& to_light, double weight, double density) {
            sum += weight * pyramid.mean(aboutNormal(normal, to_light), 1 / (samples * density));
            weights += weight;
        });
    return sum / weights;
}

} // namespace

glm::dvec3 cubeDirection(uint32_t face, double x, double y) {
    const double s = 2 * x - 1;
    const double t = 2 * y - 1;
    const std::array<glm::dvec3, kFaces> towards = {
        {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}}};
    return glm::normalize(towards[face]);
}

CubePlace cubePlace(const glm::dvec3& d) {
    const glm::dvec3 size = glm::abs(d);
    const auto on = [](uint32_t face, double s, double t, double major) {
        return CubePlace{face, 0.5 * (s / major + 1), 0.5 * (t / major + 1)};
    };
    if (size.z >= size.x && size.z >= size.y) {
        return d.z >= 0 ? on(4, d.x, -d.y, size.z) : on(5, -d.x, -d.y, size.z);
    }
    if (size.y >= size.x) {
        return d.y >= 0 ? on(2, d.x, d.z, size.y) : on(3, d.x, -d.z, size.y);
    }
    return d.x >= 0 ? on(0, -d.z, -d.y, size.x) : on(1, d.z, -d.y, size.x);
}

glm::dvec3 CubeLevel::texel(uint32_t face, int64_t column, int64_t row) const {
    const double x = (static_cast<double>(column) + 0.5) / size_px;
    const double y = (static_cast<double>(row) + 0.5) / size_px;
    const bool on_face = x > 0 && x < 1 && y > 0 && y < 1;
    return texelAt(*this, on_face ? CubePlace{face, x, y} : cubePlace(cubeDirection(face, x, y)));
}

glm::dvec3 CubeLevel::at(const glm::dvec3& direction) const {
    const CubePlace place = cubePlace(direction);
    const glm::dvec2 position = glm::dvec2(place.x, place.y) * double(size_px) - 0.5;
    const glm::dvec2 corner = glm::floor(position);
    const glm::dvec2 share = position - corner;
    const auto of = [&](int64_t dx, int64_t dy) {
        return texel(place.face, static_cast<int64_t>(corner.x) + dx,
                     static_cast<int64_t>(corner.y) + dy);
    };
    return glm::mix(glm::mix(of(0, 0), of(1, 0), share.x), glm::mix(of(0, 1), of(1, 1), share.x),
                    share.y);
}

glm::dvec3 Prefiltered::at(const glm::dvec3& direction, double roughness) const {
    const double level = levelOf(roughness, levels.size());
    const auto finer = std::min(static_cast<size_t>(level), levels.size() - 2);
    return glm::mix(levels[finer].at(direction), levels[finer + 1].at(direction),
                    level - static_cast<double>(finer));
}

double levelOf(double roughness, size_t level_count) {
    const double second = roughnessOf(1, level_count);
    return roughness < second ? roughness * roughness / (second * second)
                              : 1 + 2 * std::log2(std::min(roughness, 1.0) / second);
}

Prefiltered prefilter(const Pyramid& pyramid, const PrefilterSize& size) {
    Prefiltered out;
    const auto count = static_cast<size_t>(std::bit_width(size.finest_px / kCoarsestLevel_px));
    for (size_t i = 0; i < count; ++i) {
        CubeLevel level{size.finest_px >> i, roughnessOf(i, count), {}};
        const size_t texels = size_t{kFaces} * level.size_px * level.size_px;
        level.rgb.resize(texels * 3);
        onThreads(texels, threadCount(texels, 64), [&](size_t, size_t begin, size_t end) {
            for (size_t at = begin; at < end; ++at) {
                const glm::dvec3 normal = texelDirection(level.size_px, at);
                const glm::vec3 value =
                    i == 0 ? pyramid.mean(normal, 4 * std::numbers::pi / double(texels))
                           : filtered(pyramid, normal, level.roughness, size.samples);
                std::copy_n(&value.x, 3, &level.rgb[at * 3]);
            }
        });
        out.levels.push_back(std::move(level));
    }
    return out;
}

} // namespace froxel::environment
