#include "settings/camera.h"

#include <algorithm>
#include <cmath>

namespace froxel::settings {

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

Camera overview(const Sphere& sphere_world, double aspect, const glm::dvec3& toward_eye) {
    const Camera usual;
    const double narrower = std::min(1.0, aspect); // of the picture's halves, over its half height
    const double half_angle = std::atan(narrower * std::tan(0.5 * usual.yfov_rad));
    const double radius_m = std::max(sphere_world.radius_m, 1e-6); // a point has a distance, too
    const double distance_m = 1.05 * radius_m / std::sin(half_angle);
    const glm::dvec3& center = sphere_world.center;
    Camera camera = lookAt(center + glm::normalize(toward_eye) * distance_m, center, {0, 1, 0});
    camera.near_m = std::min(camera.near_m, 1e-3 * distance_m);
    return camera;
}

} // namespace froxel::settings
