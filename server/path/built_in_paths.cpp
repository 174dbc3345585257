#include "path/built_in_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::path {
namespace {

constexpr size_t kTurntableKeys = 24; // within 1.2e-4 of its radius of a circle

PathKeys turntable(const settings::Camera& first, double seconds) {
    PathKeys path{.keys = {}, .seconds = seconds, .constant_speed = true, .loop = true};
    const glm::dvec3 target = first.target_world();
    const glm::dvec3 from = first.eye_world - target;
    const double radius = std::hypot(from.x, from.z);
    // Of a camera that looks straight down: about its own axis is no way at all.
    const double begin = std::atan2(from.x, from.z);
    const double around = std::max(radius, 1e-3 * first.focus_m);
    for (size_t i = 0; i < kTurntableKeys; ++i) {
        const double share = static_cast<double>(i) / double{kTurntableKeys};
        const double angle = begin + 2 * std::numbers::pi * share;
        settings::Camera camera = settings::lookAt(
            target + glm::dvec3(around * std::sin(angle), from.y, around * std::cos(angle)), target,
            {0, 1, 0});
        camera.projection = first.projection;
        camera.yfov_rad = first.yfov_rad;
        camera.near_m = first.near_m;
        path.keys.push_back({seconds * share, camera});
    }
    return path;
}

// How far the eye may go along its way until it leaves the box.
double wayThrough(const BoundsD3& box, const glm::dvec3& eye, const glm::dvec3& ahead) {
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double end = ahead[axis] > 0 ? box.max[axis] : box.min[axis];
        if (std::abs(ahead[axis]) > 1e-6) {
            const double way = (end - eye[axis]) / ahead[axis];
            farthest = farthest == 0 ? way : std::min(farthest, way);
        }
    }
    return std::max(farthest, 0.0);
}

PathKeys flythrough(const scene::Scene& scene, const settings::Camera& first, double seconds) {
    PathKeys path{.keys = {}, .seconds = seconds, .constant_speed = false, .loop = false};
    std::vector<settings::Camera> stops;
    for (const scene::NamedCamera& camera : scene.cameras) {
        if (camera.camera.projection == settings::Projection::kPerspective) {
            stops.push_back(camera.camera);
        }
    }
    if (stops.size() < 2) {
        const glm::dvec3 ahead = -first.world_from_view[2];
        const double way = wayThrough(scene.bounds_world, first.eye_world, ahead);
        settings::Camera last = first;
        last.eye_world += ahead * (way > 0 ? 0.9 * way : first.focus_m / 2);
        stops = {first, last};
    }
    stops.resize(std::min(stops.size(), kMaxKeys));
    const auto steps = static_cast<double>(stops.size() - 1);
    for (size_t i = 0; i < stops.size(); ++i) {
        path.keys.push_back({seconds * static_cast<double>(i) / steps, stops[i]});
    }
    return path;
}

} // namespace

PathKeys builtInPath(BuiltIn path,
                     const scene::Scene& scene,
                     const settings::Camera& first,
                     double seconds) {
    return path == BuiltIn::kTurntable ? turntable(first, seconds)
                                       : flythrough(scene, first, seconds);
}

} // namespace froxel::path
