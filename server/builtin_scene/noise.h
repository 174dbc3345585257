// Tileable noise from an integer hash: the same on every machine, no tables to seed, no libm.
#pragma once

#include "core/math.h"

#include <cstdint>

namespace froxel::builtin_scene {

// A well-mixed hash of a lattice point.
[[nodiscard]] uint32_t hashLattice(int32_t x, int32_t y, uint32_t seed);

// The same hash as a number in [0, 1).
[[nodiscard]] float randomAt(int32_t x, int32_t y, uint32_t seed);

// Gradient noise in about [-1, 1]; repeats every `period` units in both axes (period >= 1).
[[nodiscard]] float gradientNoise(glm::vec2 point, int32_t period, uint32_t seed);

// `octaves` of gradient noise, each twice as fine and half as strong; about [-1, 1].
[[nodiscard]] float fractalNoise(glm::vec2 point, int32_t period, uint32_t octaves, uint32_t seed);

// Distances to the nearest and second nearest of one jittered point a lattice cell.
struct CellNoise {
    float nearest = 0;
    float second = 0;
    uint32_t id = 0; // hash of the nearest cell
};
[[nodiscard]] CellNoise cellNoise(glm::vec2 point, int32_t period, uint32_t seed);

} // namespace froxel::builtin_scene
