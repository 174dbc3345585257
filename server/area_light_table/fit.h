// Fits linearly transformed cosines to a lobe: a cosine whose directions are turned by a matrix M
// has about the lobe's shape, and its integral over a polygon is the cosine's over the polygon
// under M^-1 (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines").
#pragma once

#include "area_light_table/lobe.h"

#include <vector>

namespace froxel::area_light_table {

// M^-1 = ((a, 0, b), (0, 1, 0), (c, 0, d)), where +x is the eye's side of the surface.
struct Entry {
    float a = 1;
    float b = 0;
    float c = 0;
    float d = 1;
    float albedo = 0;  // the lobe's integral over the hemisphere
    float grazing = 0; // that times (1 - l.h)^5
    float padding0 = 0;
    float padding1 = 0;
};

// Rows by roughness, least first; in each kSize entries by the angle to the eye, none first.
[[nodiscard]] std::vector<Entry> fit(Lobe lobe);

} // namespace froxel::area_light_table
