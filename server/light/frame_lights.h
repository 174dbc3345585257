// One frame's lights as the shaders and the light assignment read them.
#pragma once

#include "interface/light_io.h"

#include <vector>

namespace froxel::light {

// A spot's outer half angle, made in double: assignment cuts with it, shading uses io::Spot.
struct SpotCone {
    double cos_outer = 0;
    double sin_outer = 1;
};

// Everything is relative to the eye, in right-handed view space (the camera looks along -Z).
// An index into `lights` is THE light index: seeded points first, then the scene's point and spot
// lights in file order, then the placed ones by id. Keep one FrameLights and evaluate into it
// again: its buffers are reused.
struct FrameLights {
    std::vector<io::Light> lights;
    std::vector<float> radii_m;  // of lights; infinity: no range limit
    std::vector<io::Spot> spots; // named by io::Light::spot
    std::vector<SpotCone> cones; // of spots
    std::vector<io::DirectionalLight> directionals;
};

} // namespace froxel::light
