#include "view/camera.h"

#include <algorithm>
#include <cmath>

namespace froxel::view {

Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    Camera camera;
    camera.eye_world = eye;
    const glm::dvec3 toward = target - eye;
    const double distance = glm::length(toward);
    if (!(distance > 0)) {
        return camera;
    }
    const glm::dvec3 back = -toward / distance;
    glm::dvec3 right = glm::cross(up, back);
    // 1e-9: below this the cross product of unit vectors is rounding noise.
    if (glm::length(right) <= 1e-9 * glm::length(up) || glm::length(up) == 0) {
        const glm::dvec3 axis = std::abs(back.y) > 0.5 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
        right = glm::cross(axis, back);
    }
    right = glm::normalize(right);
    camera.world_from_view = glm::dmat3(right, glm::cross(back, right), back);
    camera.focus_m = distance;
    return camera;
}

Camera overview(const BoundsD3& bounds) {
    if (bounds.empty()) {
        return lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    }
    const double radius_m = std::max(0.5 * glm::length(bounds.size()), 1e-3);
    Camera camera;
    const double distance_m = 1.1 * radius_m / std::sin(0.5 * camera.yfov_rad);
    const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(0.5, 0.35, 1));
    camera = lookAt(bounds.center() + toward_eye * distance_m, bounds.center(), {0, 1, 0});
    camera.near_m = std::min(camera.near_m, 1e-3 * distance_m);
    return camera;
}

} // namespace froxel::view
