// What poses share about transforms.
#pragma once

#include "core/math.h"

#include <cmath>
#include <optional>

namespace froxel::motion {

// A box that holds a transformed one.
[[nodiscard]] inline BoundsD3 transformed(const BoundsD3& box, const glm::dmat4& to_from_box) {
    BoundsD3 result;
    for (unsigned corner = 0; corner < 8 && !box.empty(); ++corner) {
        const glm::dvec3 point((corner & 1U) != 0 ? box.max.x : box.min.x,
                               (corner & 2U) != 0 ? box.max.y : box.min.y,
                               (corner & 4U) != 0 ? box.max.z : box.min.z);
        result.add(glm::dvec3(to_from_box * glm::dvec4(point, 1)));
    }
    return result;
}

// Unit columns right, up, back of a node whatever its scale; a mirrored node keeps its view
// direction and its up. None: its scale leaves no direction.
[[nodiscard]] inline std::optional<glm::dmat3> axesOf(const glm::dmat4& world_from_node) {
    const glm::dvec3 back(world_from_node[2]);
    const glm::dvec3 right = glm::cross(glm::dvec3(world_from_node[1]), back);
    const double back_length = glm::length(back);
    const double right_length = glm::length(right);
    if (!(back_length > 0) || !(right_length > 0)) {
        return std::nullopt;
    }
    const glm::dvec3 z = back / back_length;
    const glm::dvec3 x = right / right_length;
    return glm::dmat3(x, glm::cross(z, x), z);
}

} // namespace froxel::motion
