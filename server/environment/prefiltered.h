// The split sum's first factor (glossy.h) for all directions and roughnesses: a cube map whose
// levels are by roughness.
#pragma once

#include "environment/pyramid.h"

#include <cstddef>
#include <cstdint>

namespace froxel::environment {

// The faces and their axes as Vulkan has them (1.3, "Cube Map Face Selection"): +X -X +Y -Y +Z -Z.
// x and y: 0 to 1, to the right and down.
[[nodiscard]] glm::dvec3 cubeDirection(uint32_t face, double x, double y);

struct CubePlace {
    uint32_t face = 0;
    double x = 0;
    double y = 0;
};
[[nodiscard]] CubePlace cubePlace(const glm::dvec3& direction);

struct CubeLevel {
    uint32_t size_px = 0;
    double roughness = 0;
    std::vector<float> rgb; // [face][y][x][3]

    // Column and row from -1 to size_px: beyond its face's edge it is the one that lies there on
    // the neighbour.
    [[nodiscard]] glm::dvec3 texel(uint32_t face, int64_t column, int64_t row) const;
    // Between the centres of texels, linearly, across edges too.
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& direction) const;
};

// The finest level is a mirror's: the mean radiance of each texel. The last is of roughness 1 and
// kCoarsestLevel_px wide. From the second on, alpha doubles where texels halve, so that a lobe is
// as many texels wide in each, about six.
inline constexpr uint32_t kCoarsestLevel_px = 4;
struct Prefiltered {
    std::vector<CubeLevel> levels;

    // Between two levels, linearly.
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& direction, double roughness) const;
};

// Where a roughness lies among so many levels: 0 to level_count - 1.
[[nodiscard]] double levelOf(double roughness, size_t level_count);

struct PrefilterSize {
    uint32_t finest_px = 128; // a power of two, at least 4 times kCoarsestLevel_px
    uint32_t samples = 256;   // of each texel but the finest level's
};
[[nodiscard]] Prefiltered prefilter(const Pyramid& pyramid, const PrefilterSize& size);

} // namespace froxel::environment
