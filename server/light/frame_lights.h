// One frame's lights as the shaders and the light assignment read them.
#pragma once

#include "interface/area_io.h"
#include "interface/light_io.h"
#include "light/falloff.h"

#include <glm/geometric.hpp>

#include <vector>

namespace froxel::light {

// A spot's outer half angle, made in double: assignment cuts with it, shading uses io::Spot.
struct SpotCone {
    double cos_outer = 0;
    double sin_outer = 1;
};

// Everything is relative to the eye, in right-handed view space (the camera looks along -Z).
// An index into `lights` is THE light index: seeded points first, then the scene's point and spot
// lights in file order, then the placed ones by id, but that one which stands for another has its
// index. Keep one FrameLights and evaluate into it again: its buffers are reused.
struct FrameLights {
    std::vector<io::Light> lights;
    std::vector<float> radii_m;       // of lights; infinity: no range limit
    std::vector<io::Spot> spots;      // named by io::Light::spot
    std::vector<SpotCone> cones;      // of spots
    std::vector<io::AreaLight> areas; // named by io::Spot::area
    uint32_t first_area = 0;          // of lights; where there are areas
    std::vector<io::DirectionalLight> directionals;
    double nearest_m = kNearest_m; // nearestDistance() of the scene
    double banded_radius_m = 1;    // mostBandedRadius() of the scene
};

// From a light's centre to its farthest corner, metres; 0 where it is a point.
[[nodiscard]] inline float extentOf(const io::AreaLight& area) {
    return glm::length(area.half_right_view + area.half_up_view);
}
[[nodiscard]] inline float extentOf(const FrameLights& lights, const io::Light& light) {
    const uint32_t area = light.spot == io::kNoSpot ? io::kNoArea : lights.spots[light.spot].area;
    return area < lights.areas.size() ? extentOf(lights.areas[area]) : 0.0F;
}

} // namespace froxel::light
