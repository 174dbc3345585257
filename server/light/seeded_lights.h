// Point lights from a seed: a closed formula of (seed, index, time), equal on every machine.
#pragma once

#include "core/math.h"
#include "interface/light_io.h"
#include "light/light_places.h"
#include "settings/camera.h"
#include "settings/settings.h"

#include <memory>
#include <span>
#include <vector>

namespace froxel::light {

// Where seeded lights move: all over one box, or each in a small one at a place of its own.
struct SeededSpace {
    BoundsD3 box_world; // m
    // Null or none: the box. Where there are more lights they share places.
    std::shared_ptr<const std::vector<LightPlace>> places = nullptr;
};

// Fills `out` from `begin` to `end` (element i is light i of the seed), many lights by several
// threads: each light is its own formula, so how many does not matter. On every axis a light runs
// to and fro through the box at a constant speed, a triangle wave with a uniform phase: the density
// is uniform at every time, and no light leaves the box. Overall speeds are 0.2 to 1.5 m/s of the
// clock. At a place the box has a side of 0.3 of the lights' radius, its middle is 0.25 of it off
// the surface, and speeds are a quarter.
//
// The wave's argument is phase + rate * clock in double, less its nearest whole number: exact but
// for the product's rounding, 2^-53 of its size. At 1e9 s, 1.5 m/s and a 10 m box that is 1e-8 of a
// period, 0.2 um.
void fillSeededLights(const settings::Lights& settings,
                      const settings::Camera& camera,
                      const SeededSpace& space,
                      double time_s,
                      size_t begin,
                      size_t end,
                      std::span<io::Light> out);

// The same lights in world space, before they are rounded.
struct SeededLight {
    glm::dvec3 position_world{0};
    glm::vec3 color{0}; // linear, times intensity
};
[[nodiscard]] std::vector<SeededLight>
seededLights(const settings::Lights& settings, const SeededSpace& space, double time_s);
// The one of index `index`.
[[nodiscard]] SeededLight seededLight(const settings::Lights& settings,
                                      const SeededSpace& space,
                                      double time_s,
                                      uint32_t index);

// 1 / radius^2 as the shaders take it; finite for every radius > 0, and 0 for infinity.
[[nodiscard]] float inverseRadius2(double radius_m);

} // namespace froxel::light
