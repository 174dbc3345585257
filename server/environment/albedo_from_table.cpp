#include "environment/albedo.h"

#include <algorithm>
#include <cmath>

namespace froxel::environment {

Albedo albedoFromTable(double n_dot_v, double roughness) {
    const double x = albedoColumn(n_dot_v);
    const double y = albedoRow(roughness);
    const auto column = std::min(static_cast<uint32_t>(x), kAlbedoTableSize - 2);
    const auto row = std::min(static_cast<uint32_t>(y), kAlbedoTableSize - 2);
    const auto between = [&](size_t value) {
        const auto at = [&](uint32_t r, uint32_t c) {
            const size_t entry = size_t{r} * kAlbedoTableSize + c;
            return static_cast<double>(albedoTable()[2 * entry + value]);
        };
        return std::lerp(std::lerp(at(row, column), at(row, column + 1), x - column),
                         std::lerp(at(row + 1, column), at(row + 1, column + 1), x - column),
                         y - row);
    };
    return {between(0), between(1)};
}

} // namespace froxel::environment
