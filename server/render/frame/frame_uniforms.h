// The frame's constants for the shaders: a pure function of settings.
#pragma once

#include "cluster/cluster_grid.h"
#include "core/math.h"
#include "interface/frame_io.h"
#include "settings/settings.h"

namespace froxel::render {

// How view space maps to the screen and back, in double.
struct ViewProjection {
    glm::dvec2 clip_scale{1, 1};
    glm::dvec2 clip_offset{0, 0}; // times w
    double far_m = 0;             // orthographic only: where depth reaches 0
};

// far_m: the farthest depth of the scene, for orthographic cameras (perspective is infinite).
[[nodiscard]] ViewProjection
makeProjection(const settings::Camera& camera, const settings::Size& size, double far_m);

// grid: null where no lists are used.
[[nodiscard]] io::Frame makeFrameUniforms(const settings::ViewSettings& settings,
                                          const ViewProjection& projection,
                                          const cluster::ClusterGrid* grid,
                                          uint32_t light_count,
                                          uint32_t directional_count);

} // namespace froxel::render
