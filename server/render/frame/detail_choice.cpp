#include "render/frame/detail_choice.h"

#include <algorithm>
#include <cmath>

namespace froxel::render {
namespace {

// No less than the largest singular value, and that where axes stay orthogonal: the root of the
// largest row sum of M^T M, which bounds its eigenvalues (Gershgorin).
float largestScale(const glm::mat3& linear) {
    const glm::mat3 squared = glm::transpose(linear) * linear;
    float most = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 sizes = glm::abs(squared[i]);
        most = std::max(most, sizes.x + sizes.y + sizes.z);
    }
    return std::sqrt(most);
}

} // namespace

DetailChoice::DetailChoice(float error_px,
                           const settings::Camera& camera,
                           const settings::Size& size,
                           const ViewProjection& projection,
                           const glm::mat4& view_from_object)
    : error_px_(error_px), perspective_(camera.projection == settings::Projection::kPerspective),
      near_m_(static_cast<float>(camera.near_m)), scale_(largestScale(glm::mat3(view_from_object))),
      rows_(glm::transpose(view_from_object)) {
    const glm::dvec2 half_px(size.width_px * 0.5, size.height_px * 0.5);
    const glm::dvec2 pixels = glm::abs(projection.clip_scale) * half_px;
    pixels_ = static_cast<float>(std::max(pixels.x, pixels.y));
    const glm::dvec2 corner = (1.0 + glm::abs(projection.clip_offset)) / projection.clip_scale;
    obliquity_ = static_cast<float>(std::sqrt(1 + glm::dot(corner, corner)));
}

// A point at depth z, whose ray is o times as long, moves by no more than pixels * o / z for each
// metre that it is moved.
bool DetailChoice::isEnough(const DetailError& detail) const {
    if (detail.error == 0) {
        return true;
    }
    const float error_px = pixels_ * scale_ * detail.error;
    if (!perspective_ || !(error_px < io::kNothingCoarser.error)) {
        return error_px <= error_px_;
    }
    const glm::vec4 center(detail.center, 1.0F);
    const glm::vec3 view(glm::dot(rows_[0], center), glm::dot(rows_[1], center),
                         glm::dot(rows_[2], center));
    const float reach = detail.radius * scale_;
    const float depth = -view.z - reach;
    if (!(depth >= near_m_)) {
        return false;
    }
    const float oblique = std::min((glm::length(view) + reach) / depth, obliquity_);
    return error_px * oblique <= error_px_ * depth;
}

} // namespace froxel::render
