#include "builtin_scene/noise.h"

#include <array>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

int32_t wrap(int32_t value, int32_t period) {
    const int32_t rest = value % period;
    return rest < 0 ? rest + period : rest;
}

float quintic(float t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

// Sixteen directions, so that no gradient needs a sine.
constexpr std::array<glm::vec2, 16> kGradients = {
    glm::vec2{1.0F, 0.0F},  {0.9239F, 0.3827F},   {0.7071F, 0.7071F},   {0.3827F, 0.9239F},
    glm::vec2{0.0F, 1.0F},  {-0.3827F, 0.9239F},  {-0.7071F, 0.7071F},  {-0.9239F, 0.3827F},
    glm::vec2{-1.0F, 0.0F}, {-0.9239F, -0.3827F}, {-0.7071F, -0.7071F}, {-0.3827F, -0.9239F},
    glm::vec2{0.0F, -1.0F}, {0.3827F, -0.9239F},  {0.7071F, -0.7071F},  {0.9239F, -0.3827F}};

} // namespace

uint32_t hashLattice(int32_t x, int32_t y, uint32_t seed) {
    uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1U ^ static_cast<uint32_t>(y) * 0x85ebca77U ^
                 seed * 0xc2b2ae3dU;
    h = (h ^ (h >> 16U)) * 0x7feb352dU;
    h = (h ^ (h >> 15U)) * 0x846ca68bU;
    return h ^ (h >> 16U);
}

float randomAt(int32_t x, int32_t y, uint32_t seed) {
    return static_cast<float>(hashLattice(x, y, seed) >> 8U) * (1.0F / 16777216.0F);
}

float gradientNoise(glm::vec2 point, int32_t period, uint32_t seed) {
    const glm::vec2 base = glm::floor(point);
    const glm::vec2 f = point - base;
    const int32_t x0 = wrap(static_cast<int32_t>(base.x), period);
    const int32_t y0 = wrap(static_cast<int32_t>(base.y), period);
    const int32_t x1 = x0 + 1 == period ? 0 : x0 + 1;
    const int32_t y1 = y0 + 1 == period ? 0 : y0 + 1;
    const auto corner = [&](int32_t x, int32_t y, glm::vec2 offset) {
        return glm::dot(kGradients[hashLattice(x, y, seed) >> 28U], offset);
    };
    const float a = corner(x0, y0, f);
    const float b = corner(x1, y0, f - glm::vec2(1, 0));
    const float c = corner(x0, y1, f - glm::vec2(0, 1));
    const float d = corner(x1, y1, f - glm::vec2(1, 1));
    const float u = quintic(f.x);
    const float v = quintic(f.y);
    const float top = a + (b - a) * u;
    const float bottom = c + (d - c) * u;
    return 1.4F * (top + (bottom - top) * v);
}

float fractalNoise(glm::vec2 point, int32_t period, uint32_t octaves, uint32_t seed) {
    float sum = 0;
    float strength = 0.55F;
    for (uint32_t octave = 0; octave < octaves; ++octave) {
        sum += strength * gradientNoise(point, period, seed + octave);
        point *= 2.0F;
        period *= 2;
        strength *= 0.5F;
    }
    return sum;
}

CellNoise cellNoise(glm::vec2 point, int32_t period, uint32_t seed) {
    const glm::vec2 base = glm::floor(point);
    CellNoise result{8.0F, 8.0F, 0};
    for (int32_t dy = -1; dy <= 1; ++dy) {
        for (int32_t dx = -1; dx <= 1; ++dx) {
            const int32_t x = static_cast<int32_t>(base.x) + dx;
            const int32_t y = static_cast<int32_t>(base.y) + dy;
            const uint32_t id = hashLattice(wrap(x, period), wrap(y, period), seed);
            const glm::vec2 jitter(static_cast<float>(id & 0xffffU) / 65536.0F,
                                   static_cast<float>(id >> 16U) / 65536.0F);
            const glm::vec2 site = glm::vec2(static_cast<float>(x), static_cast<float>(y)) + jitter;
            const float distance = glm::length(site - point);
            if (distance < result.nearest) {
                result = {distance, result.nearest, id};
            } else if (distance < result.second) {
                result.second = distance;
            }
        }
    }
    return result;
}

} // namespace froxel::builtin_scene
