#include "light/light_cutoff.h"

#include "core/parallel.h"
#include "light/falloff.h"
#include "light/seeded_lights.h"

#include <algorithm>
#include <cmath>

namespace froxel::light {

double cutRadius(const glm::vec3& color, double radius_m, double cutoff, double nearest_m) {
    const double strongest = strongestChannel(color);
    if (!(strongest > 0)) {
        return 0;
    }
    // (1 - d^4/r^4)^2 / d^2 = cutoff / strongest, or 1 - d^4/r^4 - d s = 0: falling and concave,
    // so Newton's method comes down to the root from any start beyond it.
    const double s = std::sqrt(cutoff / strongest);
    const double inv_r4 = 1.0 / (radius_m * radius_m * radius_m * radius_m);
    double d = std::min(radius_m, 1.0 / s);
    constexpr int kSteps = 8; // 6 leave an error below a float's rounding
    for (int i = 0; i < kSteps; ++i) {
        const double d3 = d * d * d;
        d += (1.0 - d3 * d * inv_r4 - d * s) / (4.0 * d3 * inv_r4 + s);
    }
    return d > nearest_m ? d : 0.0;
}

void cutLights(FrameLights& lights, double cutoff, bool compensated) {
    constexpr size_t kLightsPerThread = 4096;
    const auto cut = [&](size_t /*part*/, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            io::Light& light = lights.lights[i];
            const auto whole = static_cast<double>(lights.radii_m[i]);
            const double radius = cutRadius(light.color, whole, cutoff, lights.nearest_m);
            if (compensated && radius > 0 && std::isfinite(whole)) {
                light.color *= static_cast<float>(whole / radius);
            }
            lights.radii_m[i] = static_cast<float>(radius);
            light.inv_radius2 = inverseRadius2(static_cast<double>(lights.radii_m[i]));
        }
    };
    const size_t count = lights.lights.size();
    onThreads(count, threadCount(count, kLightsPerThread), cut);
}

} // namespace froxel::light
