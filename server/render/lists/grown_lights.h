// Lights as they are assigned where a G-buffer stores positions in halves.
#pragma once

#include "core/parallel.h"
#include "light/frame_lights.h"

namespace froxel::render {

// A position in halves lies up to 2^-11 of each coordinate off its pixel, and so perhaps in another
// cluster: lights are assigned as if they reached that much farther. Spots as points.
inline void growForHalves(const light::FrameLights& lights, light::FrameLights& grown) {
    constexpr float kShare = 1.0F / 1024.0F;
    constexpr size_t kLightsPerThread = 32'768;
    grown.lights = lights.lights;
    grown.radii_m = lights.radii_m;
    grown.nearest_m = lights.nearest_m;
    const size_t count = grown.lights.size();
    onThreads(count, threadCount(count, kLightsPerThread),
              [&](size_t /*part*/, size_t begin, size_t end) {
                  for (size_t i = begin; i < end; ++i) {
                      io::Light& light = grown.lights[i];
                      float& radius_m = grown.radii_m[i];
                      radius_m += kShare * glm::length(glm::abs(light.position_view) + radius_m);
                      light.inv_radius2 = 1.0F / (radius_m * radius_m);
                      light.spot = io::kNoSpot;
                  }
              });
}

} // namespace froxel::render
