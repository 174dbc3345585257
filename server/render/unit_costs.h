// What a device takes for one of each: measured on lavapipe on two cores and on an H200.
#pragma once

namespace froxel::render {

// Seconds.
struct UnitCosts {
    double triangle = 0;      // culled, set up, rastered, without its pixels
    double depth_pixel = 0;   // depth alone
    double surface_pixel = 0; // a material's textures, with depth
    double resolve_pixel = 0; // likewise in compute, from ids; for each dispatch over the picture
    double lit_pixel = 0;     // shading without lights
    double screen_pixel = 0;  // another pass over the picture
    double pair = 0;          // a light at a pixel, in compute
    double single_pair = 0;   // likewise where lights come one at a time: debug views
    double fragment_pair = 0; // in the fragment stage
    double loop_light = 0;    // the next light of a loop, however few pixels go through it
    double shadow_pair = 0;   // more, where the light has a shadow map
    double area_pair = 0;     // a rectangle
    double froxel = 0;        // of fog, without lights
    double bloom_tap = 0;
    double wire_line = 0; // of an overlay
};

// Of a device that takes so many times as long for lights, and for surfaces.
[[nodiscard]] constexpr UnitCosts scaled(UnitCosts unit, double lights, double surfaces) {
    for (double UnitCosts::*cost : {&UnitCosts::triangle, &UnitCosts::depth_pixel,
                                    &UnitCosts::surface_pixel, &UnitCosts::resolve_pixel}) {
        unit.*cost *= surfaces;
    }
    for (double UnitCosts::*cost :
         {&UnitCosts::lit_pixel, &UnitCosts::screen_pixel, &UnitCosts::pair,
          &UnitCosts::single_pair, &UnitCosts::loop_light, &UnitCosts::fragment_pair,
          &UnitCosts::shadow_pair, &UnitCosts::area_pair, &UnitCosts::froxel, &UnitCosts::bloom_tap,
          &UnitCosts::wire_line}) {
        unit.*cost *= lights;
    }
    return unit;
}

inline constexpr UnitCosts kCpuUnitCosts{.triangle = 3e-7,
                                         .depth_pixel = 1.2e-8,
                                         .surface_pixel = 6e-8,
                                         .resolve_pixel = 3e-8,
                                         .lit_pixel = 4e-8,
                                         .screen_pixel = 4e-8,
                                         .pair = 5e-9,
                                         .single_pair = 1.2e-8,
                                         .fragment_pair = 2.2e-8,
                                         .loop_light = 0,
                                         .shadow_pair = 6e-8,
                                         .area_pair = 1.5e-7,
                                         .froxel = 6e-8,
                                         .bloom_tap = 2e-9,
                                         .wire_line = 2.5e-6};
inline constexpr UnitCosts kGpuUnitCosts{.triangle = 2e-9,
                                         .depth_pixel = 1e-10,
                                         .surface_pixel = 6e-10,
                                         .resolve_pixel = 1e-10,
                                         .lit_pixel = 1e-10,
                                         .screen_pixel = 1e-10,
                                         .pair = 8e-12,
                                         .single_pair = 9e-11,
                                         .fragment_pair = 4.2e-10,
                                         .loop_light = 1.5e-9,
                                         .shadow_pair = 3e-11,
                                         .area_pair = 3e-11,
                                         .froxel = 1e-10,
                                         .bloom_tap = 5.5e-12,
                                         .wire_line = 1e-8};

} // namespace froxel::render
