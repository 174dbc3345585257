// What a device takes for one of each: measured on lavapipe on two cores and on an H200.
#pragma once

#include <algorithm>

namespace froxel::render {

// Of lights that pixels loop over, seconds. A loop of few pixels, which nothing can cut, waits for
// each of its lights; on a CPU device a workgroup's pixels have one core.
struct PairCost {
    double pair = 0; // a light at a pixel
    double loop = 0; // the next light of one pixel's loop, however few pixels go through it
};

[[nodiscard]] constexpr PairCost scaled(const PairCost& cost, double lights) {
    // A loop waits: more of it at once is no quicker.
    return {cost.pair * lights, cost.loop * std::max(lights, 1.0)};
}

// Seconds.
struct UnitCosts {
    bool is_cpu = false;      // the kind of device
    double lights_scale = 1;  // by which scaled() has multiplied
    double posed_vertex = 0;  // moved by joints and morph targets
    double triangle = 0;      // culled, set up, rastered, without its pixels
    double depth_pixel = 0;   // depth alone
    double surface_pixel = 0; // a material's textures, with depth
    double resolve_pixel = 0; // likewise in compute, from ids; for each dispatch over the picture
    double lit_pixel = 0;     // shading without lights
    double screen_pixel = 0;  // another pass over the picture
    double copied_pixel = 0;  // a packed pixel on its way to the host, which a CPU device has not
    double assign = 0;        // light lists on the device, however few lights
    double assign_light = 0;  // each light there
    PairCost compute;
    PairCost fragment;
    PairCost counting;     // pairs that are counted, by debug views too
    double area_pair = 0;  // more, where the light is a rectangle
    double wire_line = 0;  // of an overlay
    double wire_pixel = 0; // that such a line covers
};

// Of a device that takes so many times as long for lights, and for surfaces.
[[nodiscard]] constexpr UnitCosts scaled(UnitCosts unit, double lights, double surfaces) {
    for (double UnitCosts::*cost :
         {&UnitCosts::posed_vertex, &UnitCosts::triangle, &UnitCosts::depth_pixel,
          &UnitCosts::surface_pixel, &UnitCosts::resolve_pixel}) {
        unit.*cost *= surfaces;
    }
    unit.lights_scale *= lights;
    for (double UnitCosts::*cost :
         {&UnitCosts::lit_pixel, &UnitCosts::screen_pixel, &UnitCosts::area_pair,
          &UnitCosts::wire_line, &UnitCosts::wire_pixel, &UnitCosts::copied_pixel,
          &UnitCosts::assign, &UnitCosts::assign_light}) {
        unit.*cost *= lights;
    }
    for (PairCost UnitCosts::*cost :
         {&UnitCosts::compute, &UnitCosts::fragment, &UnitCosts::counting}) {
        unit.*cost = scaled(unit.*cost, lights);
    }
    return unit;
}

// What a step takes for one of a unit of its own.
template <class Cost>
struct Measured {
    Cost cpu;
    Cost gpu;
};

// On the device of these costs.
[[nodiscard]] constexpr double onDevice(const UnitCosts& unit, const Measured<double>& cost) {
    return (unit.is_cpu ? cost.cpu : cost.gpu) * unit.lights_scale;
}
[[nodiscard]] constexpr PairCost onDevice(const UnitCosts& unit, const Measured<PairCost>& cost) {
    return scaled(unit.is_cpu ? cost.cpu : cost.gpu, unit.lights_scale);
}

inline constexpr UnitCosts kCpuUnitCosts{.is_cpu = true,
                                         .posed_vertex = 3e-7,
                                         .triangle = 3e-7,
                                         .depth_pixel = 1.2e-8,
                                         .surface_pixel = 6e-8,
                                         .resolve_pixel = 9e-8,
                                         .lit_pixel = 4e-8,
                                         .screen_pixel = 4e-8,
                                         .assign = 3e-3,
                                         .assign_light = 4e-6,
                                         .compute = {5e-9, 1.7e-6},
                                         .fragment = {2.2e-8, 4.8e-6},
                                         .counting = {1.2e-8, 6.5e-7},
                                         .area_pair = 1.5e-7,
                                         .wire_line = 5e-7,
                                         .wire_pixel = 2e-8};
inline constexpr UnitCosts kGpuUnitCosts{.posed_vertex = 1e-9,
                                         .triangle = 2e-9,
                                         .depth_pixel = 1e-10,
                                         .surface_pixel = 6e-10,
                                         .resolve_pixel = 1e-10,
                                         .lit_pixel = 1e-10,
                                         .screen_pixel = 1e-10,
                                         .copied_pixel = 8e-11,
                                         .assign = 5e-5,
                                         .assign_light = 1.25e-8,
                                         .compute = {8e-12, 1.3e-7},
                                         .fragment = {4.2e-10, 1.1e-6},
                                         .counting = {9e-11, 1e-6},
                                         .area_pair = 3e-11,
                                         .wire_line = 1e-8,
                                         .wire_pixel = 5e-11};

} // namespace froxel::render
