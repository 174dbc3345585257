#include "light/shadow_choice.h"

#include "core/parallel.h"
#include "light/falloff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace froxel::light {

namespace {

// Planes through the eye that bound what the camera sees, inwards; unit normals, in view space.
struct SeenSpace {
    struct Plane {
        glm::dvec3 normal{0};
        double offset_m = 0;
    };
    std::array<Plane, 5> planes;
    size_t count = 0;

    SeenSpace(const settings::Camera& camera, const settings::Size& size) {
        add({0, 0, -1}, 0);
        if (camera.lens_shift != glm::dvec2(0)) {
            return;
        }
        const double aspect = static_cast<double>(size.width_px) / size.height_px;
        if (camera.projection == settings::Projection::kOrthographic) {
            for (const double side : {-1.0, 1.0}) {
                add({side, 0, 0}, camera.half_height_m * aspect);
                add({0, side, 0}, camera.half_height_m);
            }
            return;
        }
        const double half = std::tan(camera.yfov_rad * 0.5);
        for (const double side : {-1.0, 1.0}) {
            add(glm::normalize(glm::dvec3(side, 0, -half * aspect)), 0);
            add(glm::normalize(glm::dvec3(0, side, -half)), 0);
        }
    }
    void add(const glm::dvec3& normal, double offset_m) { planes[count++] = {normal, offset_m}; }

    [[nodiscard]] bool meets(const glm::dvec3& center, double radius_m) const {
        return std::all_of(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const Plane& plane) {
                               return glm::dot(plane.normal, center) + plane.offset_m > -radius_m;
                           });
    }
};

// What each adds, negated, and which it is: the first in order are kept.
using Ranked = std::vector<std::pair<double, uint32_t>>;

void keepFirst(Ranked& ranked, size_t count) {
    const size_t kept = std::min(count, ranked.size());
    std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(kept),
                      ranked.end());
    ranked.resize(kept);
}

} // namespace

double importance(double luminance, double distance_m, double reach_m, double share) {
    const double nearest_m = std::max(distance_m, reach_m);
    return nearest_m > 0 ? luminance * share / (nearest_m * nearest_m) : 0.0;
}

std::vector<uint32_t> chooseShadowed(const FrameLights& lights,
                                     const settings::Camera& camera,
                                     const settings::Size& size,
                                     double farthest_m,
                                     uint32_t count) {
    constexpr size_t kLightsPerThread = 16'384;
    const SeenSpace seen(camera, size);
    const bool parallel = camera.projection == settings::Projection::kOrthographic;
    const auto valueOf = [&](const io::Light& light, double radius_m) {
        const glm::dvec3 center(light.position_view);
        const double reach_m = std::min(radius_m, farthest_m);
        // A map is drawn from one point: rectangles have none.
        const bool point = extentOf(lights, light) == 0.0F;
        if (!point || !(reach_m > 0) || !seen.meets(center, reach_m)) {
            return 0.0;
        }
        const double share =
            light.spot == io::kNoSpot ? 1.0 : 0.5 * (1.0 - lights.cones[light.spot].cos_outer);
        // Parallel rays show a ball in one size wherever it is.
        const double distance_m = parallel ? camera.half_height_m : glm::length(center);
        return importance(luminanceOf(light.color), distance_m, reach_m, share);
    };
    const size_t light_count = lights.lights.size();
    std::vector<Ranked> parts(threadCount(light_count, kLightsPerThread));
    onThreads(light_count, parts.size(), [&](size_t part, size_t begin, size_t end) {
        Ranked& ranked = parts[part];
        for (size_t i = begin; i < end; ++i) {
            const double value = valueOf(lights.lights[i], static_cast<double>(lights.radii_m[i]));
            if (value > 0) {
                ranked.emplace_back(-value, static_cast<uint32_t>(i));
            }
        }
        keepFirst(ranked, count);
    });
    Ranked best;
    for (const Ranked& ranked : parts) {
        best.insert(best.end(), ranked.begin(), ranked.end());
    }
    keepFirst(best, count);
    std::vector<uint32_t> chosen;
    for (const auto& [value, index] : best) {
        chosen.push_back(index);
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

} // namespace froxel::light
