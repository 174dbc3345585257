#include "reference/rays.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {

PixelRays::PixelRays(const settings::Camera& camera, const settings::Size& size)
    : world_from_view_(camera.world_from_view),
      parallel_(camera.projection == settings::Projection::kOrthographic),
      shift_(camera.lens_shift), size_px_(size.width_px, size.height_px) {
    const double half_height = parallel_ ? camera.half_height_m : std::tan(camera.yfov_rad / 2);
    half_extent_ = {half_height * size_px_.x / size_px_.y, half_height};
}

Ray PixelRays::through(const glm::dvec2& pixels) const {
    const glm::dvec2 from_middle(pixels.x / size_px_.x * 2 - 1, 1 - pixels.y / size_px_.y * 2);
    const glm::dvec2 at = (from_middle + shift_) * half_extent_;
    if (parallel_) {
        return {world_from_view_ * glm::dvec3(at, 0), -world_from_view_[2]};
    }
    return {glm::dvec3(0), world_from_view_ * glm::dvec3(at, -1)};
}

glm::dvec2 PixelRays::project(const glm::dvec3& point, double& along) const {
    const glm::dvec3 view = glm::transpose(world_from_view_) * point;
    along = -view.z;
    const glm::dvec2 at = glm::dvec2(view) / (parallel_ ? 1.0 : along);
    const glm::dvec2 from_middle = at / half_extent_ - shift_;
    return glm::dvec2(from_middle.x + 1, 1 - from_middle.y) * 0.5 * size_px_;
}

PlanePoint meetPlane(const Ray& ray, const Triangle& triangle) {
    const glm::dvec3 normal = glm::cross(triangle.edge1, triangle.edge2);
    const double descent = glm::dot(normal, ray.direction);
    if (descent == 0) {
        return {};
    }
    PlanePoint point;
    point.met = true;
    point.distance = glm::dot(normal, triangle.corner - ray.origin) / descent;
    // By the triangle products of the ray with two corners each (Cramer's rule), not by the point:
    // the point's own rounding would be magnified on slivers.
    const glm::dvec3 from_corner = ray.origin - triangle.corner;
    const glm::dvec3 moment = glm::cross(ray.direction, from_corner);
    point.weights = {glm::dot(triangle.edge2, moment) / descent,
                     -glm::dot(triangle.edge1, moment) / descent};
    return point;
}

glm::dvec2 clampToTriangle(const glm::dvec2& weights) {
    glm::dvec3 all(1 - weights.x - weights.y, weights.x, weights.y);
    if (std::min({all.x, all.y, all.z}) > -kPlaneGoesOn) {
        return weights;
    }
    all = glm::max(all, glm::dvec3(0));
    const double sum = all.x + all.y + all.z;
    return {all.y / sum, all.z / sum};
}

} // namespace froxel::reference
