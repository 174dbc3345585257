// Vectors to and from the wire.
#pragma once

#include "froxel/v1/common.pb.h"

#include <glm/vec3.hpp>

namespace froxel::session {

[[nodiscard]] inline glm::dvec3 vec(const v1::Vec3& value) {
    return {value.x(), value.y(), value.z()};
}

inline void fillVec(v1::Vec3& out, const glm::dvec3& value) {
    out.set_x(value.x);
    out.set_y(value.y);
    out.set_z(value.z);
}

} // namespace froxel::session
