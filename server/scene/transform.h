// Where a node stands in its parent, in parts that can be animated one by one.
#pragma once

#include "core/math.h"

#include <cmath>

namespace froxel::scene {

struct Transform {
    glm::dvec3 translation{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0}; // of any length; without direction: none
    glm::dvec3 scale{1, 1, 1};
};

// Length 0 and what is beyond double's range have no direction.
[[nodiscard]] inline bool isDirection(double length) {
    return length > 0 && std::isfinite(length);
}

// In metres, and of scales: products of two are still far from a float's end.
inline constexpr double kLargestElement = 1e15;

// Whether all elements are numbers of at most kLargestElement.
[[nodiscard]] inline bool isUsable(const glm::dmat4& transform) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!(std::abs(transform[column][row]) <= kLargestElement)) {
                return false;
            }
        }
    }
    return true;
}

// translation * rotation * scale.
[[nodiscard]] inline glm::dmat4 matrixOf(const Transform& transform) {
    const double length = glm::length(transform.rotation);
    glm::dmat4 matrix =
        isDirection(length) ? glm::mat4_cast(transform.rotation / length) : glm::dmat4(1);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= transform.scale[axis];
    }
    matrix[3] = glm::dvec4(transform.translation, 1);
    return matrix;
}

} // namespace froxel::scene
