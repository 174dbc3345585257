// The lights of a frame in double, from their definitions.
#pragma once

#include "scene/scene.h"
#include "view/settings.h"

#include <limits>
#include <vector>

namespace froxel::reference {

// The world's axes, relative to the eye.
struct PointLight {
    glm::dvec3 position{0};
    double radius2 = std::numeric_limits<double>::infinity(); // m^2; infinity: no range limit
    glm::dvec3 color{0};                                      // linear, times intensity
    // A spot's angular falloff, clamp(cos * scale + offset, 0, 1)^2; a point light's is 1.
    glm::dvec3 direction{0}; // the way the light travels
    double cone_scale = 0;
    double cone_offset = 1;
    bool shadowed = false; // what stands between it and a surface takes its light away
};

struct DirectionalLight {
    glm::dvec3 direction{0}; // unit, the way the light travels
    glm::dvec3 color{0};
};

struct Lights {
    std::vector<PointLight> points; // seeded ones, then the scene's points and spots
    std::vector<DirectionalLight> directionals;
    glm::dvec3 sky{0}; // ambient radiance
    glm::dvec3 ground{0};
};

// Shadowed: those that have maps by light/shadow_choice.h.
[[nodiscard]] Lights
lightsAt(const scene::Scene& scene, const view::ViewSettings& settings, double time_s);

} // namespace froxel::reference
