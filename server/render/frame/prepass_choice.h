// Whether a depth prepass pays: it draws every triangle once more and spares the shading of
// fragments that others cover. It never changes the picture.
#pragma once

#include <cstdint>

namespace froxel::render {

// What work costs on a class of device, in nanoseconds of a frame's time.
struct PrepassCosts {
    double triangle_ns; // one more time through the rasteriser, for depth alone
    double fragment_ns; // material, and the G-buffer's words or the sum of no lights
    double light_ns;    // each light that a fragment loops over
};

// lavapipe 22.3, two cores: 29 ms for 115,000 triangles (Sponza, 1280x720); 34 ms for the textures
// and words of 1.5 million fragments.
inline constexpr PrepassCosts kCpuPrepassCosts{250, 23, 9};
// H200, driver 580, 1920x1080: 0.84 ms for 262,000 triangles, and 0.87 ms more for 3.4 million
// fragments of the G-buffer; 12.6 ms for some 20 lights on each of 2 million pixels.
inline constexpr PrepassCosts kGpuPrepassCosts{3.2, 0.25, 0.3};

struct PrepassFacts {
    uint64_t triangle_count = 0;
    uint64_t pixel_count = 0;
    double overdraw = 1; // fragments that pass the depth test, per pixel of the picture
    double lights = 0;   // that a fragment loops over while it is drawn
};

[[nodiscard]] bool prepassPays(const PrepassFacts& facts, const PrepassCosts& costs);

} // namespace froxel::render
