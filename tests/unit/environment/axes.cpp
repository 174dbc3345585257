#include "unit/environment/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace froxel::environment {

size_t nearestAxis(const glm::dvec3& direction) {
    return static_cast<size_t>(std::max_element(kAxes.begin(), kAxes.end(),
                                                [&](const auto& a, const auto& b) {
                                                    return glm::dot(a, direction) <
                                                           glm::dot(b, direction);
                                                }) -
                               kAxes.begin());
}

} // namespace froxel::environment
