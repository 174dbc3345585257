// Which meshlets of a mesh with coarser levels a view takes.
#pragma once

#include "render/frame/frame_uniforms.h"
#include "render/scene/detail_levels.h"

#include <glm/glm.hpp>

namespace froxel::render {

// How large distances of one instance are in the picture.
class DetailChoice {
  public:
    // error_px: above 0, pixels that surfaces may be off their place. view_from_object: of the
    // instance, whose scale may differ by axis.
    DetailChoice(float error_px,
                 const settings::Camera& camera,
                 const settings::Size& size,
                 const ViewProjection& projection,
                 const glm::mat4& view_from_object);

    // Whether the meshlet is to be drawn: it is near enough to its surface, and nothing coarser is.
    [[nodiscard]] bool draws(const MeshletDetail& detail) const {
        return isEnough(detail.own) && !isEnough(detail.coarser);
    }

  private:
    // Pixels of the error: no more than those of a sphere about that one with a larger error.
    [[nodiscard]] bool isEnough(const DetailError& detail) const;

    float error_px_;
    bool perspective_;
    float near_m_;
    float pixels_;    // a metre across the view axis, 1 m before the eye; orthographic: anywhere
    float obliquity_; // at most, of rays of the picture: their length over that along the axis
    float scale_;     // metres of an object's unit, at most
    glm::mat4 rows_;  // of view_from_object
};

} // namespace froxel::render
