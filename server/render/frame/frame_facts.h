// What a frame's plan asks of scene and lights. Pure.
#pragma once

#include "cluster/light_assigner.h"
#include "core/math.h"
#include "light/frame_lights.h"
#include "settings/settings.h"

namespace froxel::render {

// Farthest depth of the scene along the view direction, for orthographic cameras.
[[nodiscard]] double farthestDepth(const settings::Camera& camera, const BoundsD3& bounds);

// Whether all local lights reach equally far. Seeded ones, which come first, have one radius.
[[nodiscard]] bool equalRadii(const light::FrameLights& lights, const settings::Lights& settings);

// Whether the loops of a subgroup could pass the 65,535 iterations that llvmpipe gives a shader:
// one for each light that passes the cull and one a batch, for every list that its pixels have.
[[nodiscard]] bool longLoops(const cluster::LightLists& lists,
                             const light::FrameLights& lights,
                             uint32_t subgroup_size);

} // namespace froxel::render
