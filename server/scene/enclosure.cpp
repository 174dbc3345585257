#include "scene/enclosure.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace froxel::scene {

namespace {

constexpr size_t kRayCount = 64;
// An open court or a hall without its roof has walls and a floor.
constexpr size_t kRoomHits = kRayCount * 2 / 3;
// Of half the diagonal: what is lined or folded has fronts much nearer to its middle.
constexpr double kLeastMedian = 0.2;
// A stool and a chest are hollow, too.
constexpr double kLeastDiagonal_m = 6;
// Of a sky's diagonal, that of all below it: the things in a room are more of the room.
constexpr double kMostOfSky = 0.15;
// A sky is half a sphere, or a bit less.
constexpr size_t kSkyHits = kRayCount / 3;
// Triangles that rays are held against, of all together: a second or two. Things whose boxes all
// lie over each other take more; what was met until then counts.
constexpr uint64_t kMostTests = uint64_t{1} << 27U;
// Starting a thread costs about as much.
constexpr size_t kTestsPerThread = 20'000;

struct Ray {
    glm::dvec3 from;
    glm::dvec3 along;
};

bool meets(const Ray& ray, const Bounds3& box, double nearest) {
    const glm::dvec3 a = (glm::dvec3(box.min) - ray.from) / ray.along;
    const glm::dvec3 b = (glm::dvec3(box.max) - ray.from) / ray.along;
    double first = 0;
    double last = nearest;
    for (int i = 0; i < 3; ++i) {
        // 0 / 0, in a side of the box: std::min and std::max leave the NaN out.
        first = std::max(first, std::min(a[i], b[i]));
        last = std::min(last, std::max(a[i], b[i]));
    }
    return first <= last;
}

// Distance in lengths of `along`, by Moeller and Trumbore (1997), and on which side; the triangle's
// own if there is none nearer than `best`.
void meetTriangle(const Ray& ray,
                  const Primitive& primitive,
                  size_t triangle,
                  std::optional<RayHit>& best) {
    const auto corner = [&](size_t k) {
        return glm::dvec3(primitive.positions[primitive.indices[3 * triangle + k]]);
    };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 ab = corner(1) - a;
    const glm::dvec3 ac = corner(2) - a;
    const glm::dvec3 p = glm::cross(ray.along, ac);
    const double det = glm::dot(ab, p);
    if (det == 0) {
        return;
    }
    const glm::dvec3 s = ray.from - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.along, q) / det;
    const double t = glm::dot(ac, q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && (!best || t < best->distance_m)) {
        best = RayHit{t, det > 0};
    }
}

// Points of a spiral with the golden angle from row to row.
std::vector<glm::dvec3> allAround() {
    const double golden_rad = glm::pi<double>() * (3 - std::sqrt(5.0));
    std::vector<glm::dvec3> directions;
    for (size_t i = 0; i < kRayCount; ++i) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / kRayCount;
        const double ring = std::sqrt(1 - y * y);
        const double angle_rad = golden_rad * static_cast<double>(i);
        directions.emplace_back(ring * std::cos(angle_rad), y, ring * std::sin(angle_rad));
    }
    return directions;
}

// About the boxes of its primitives.
BoundsD3 boundsOf(const Scene& scene, const Instance& instance) {
    BoundsD3 bounds;
    for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
        const Bounds3& box = primitive.bounds;
        for (unsigned corner = 0; !box.empty() && corner < 8; ++corner) {
            const glm::dvec3 object((corner & 1U) != 0 ? box.max.x : box.min.x,
                                    (corner & 2U) != 0 ? box.max.y : box.min.y,
                                    (corner & 4U) != 0 ? box.max.z : box.min.z);
            bounds.add(glm::dvec3(instance.world_from_object * glm::dvec4(object, 1)));
        }
    }
    return bounds;
}

double diagonalOf(const BoundsD3& bounds) {
    return bounds.empty() ? 0 : glm::length(bounds.size());
}

} // namespace

std::vector<std::optional<RayHit>> castRays(const Scene& scene,
                                            const glm::dvec3& from_world,
                                            const std::vector<glm::dvec3>& directions_world,
                                            std::optional<size_t> only) {
    std::vector<std::optional<RayHit>> hits(directions_world.size());
    uint64_t tests = 0;
    const auto all = std::span(scene.instances);
    for (const Instance& instance : only ? all.subspan(*only, 1) : all) {
        const glm::dmat4& world_from_object = instance.world_from_object;
        const double det = glm::determinant(glm::dmat3(world_from_object));
        if (det == 0 || !std::isfinite(det)) {
            continue; // flat: nothing of it has an inside
        }
        const glm::dmat4 object_from_world = glm::inverse(world_from_object);
        const glm::dvec3 from(object_from_world * glm::dvec4(from_world, 1));
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[primitive.material];
            if (material.alpha_mode == AlphaMode::kBlend || primitive.bounds.empty()) {
                continue;
            }
            // Along is not made unit again: distances stay the world's.
            const size_t triangle_count = primitive.indices.size() / 3;
            std::vector<std::pair<Ray, std::optional<RayHit>*>> met;
            for (size_t i = 0; i < hits.size() && tests <= kMostTests; ++i) {
                const Ray ray{from, glm::dmat3(object_from_world) * directions_world[i]};
                const double nearest =
                    hits[i] ? hits[i]->distance_m : std::numeric_limits<double>::infinity();
                if (meets(ray, primitive.bounds, nearest)) {
                    tests += triangle_count;
                    met.emplace_back(ray, &hits[i]);
                }
            }
            if (tests > kMostTests) {
                met.pop_back();
            }
            const size_t threads =
                std::min(threadCount(met.size() * triangle_count, kTestsPerThread), met.size() + 1);
            onThreads(met.size(), threads, [&](size_t /*thread*/, size_t begin, size_t end) {
                for (const auto& [ray, hit] : std::span(met).subspan(begin, end - begin)) {
                    for (size_t k = 0; k < triangle_count; ++k) {
                        meetTriangle(ray, primitive, k, *hit);
                    }
                }
            });
            if (tests > kMostTests) {
                return hits;
            }
        }
    }
    return hits;
}

std::optional<Surround> surroundOf(const Scene& scene) {
    std::vector<BoundsD3> boxes;
    for (const Instance& instance : scene.instances) {
        boxes.push_back(boundsOf(scene, instance));
    }
    const auto largest = std::ranges::max_element(boxes, {}, diagonalOf);
    if (boxes.size() < 2 || largest->empty()) {
        return {};
    }
    Surround surround{static_cast<size_t>(largest - boxes.begin()), {}};
    for (const BoundsD3& box : boxes) {
        if (&box != &*largest && !box.empty()) {
            surround.rest_world.add(box.min);
            surround.rest_world.add(box.max);
        }
    }
    const double rest_m = diagonalOf(surround.rest_world);
    if (rest_m == 0 || rest_m > kMostOfSky * diagonalOf(*largest)) {
        return {};
    }
    const auto hits = castRays(scene, surround.rest_world.center(), allAround(), surround.instance);
    const auto met = std::ranges::count_if(hits, [](const auto& hit) { return hit.has_value(); });
    return static_cast<size_t>(met) >= kSkyHits ? std::optional(surround) : std::nullopt;
}

bool isRoom(const Scene& scene) {
    const double diagonal_m = glm::length(scene.bounds_world.size());
    if (scene.bounds_world.empty() || !(diagonal_m >= kLeastDiagonal_m)) {
        return false;
    }
    if (surroundOf(scene)) {
        return false;
    }
    const auto hits = castRays(scene, scene.bounds_world.center(), allAround());
    std::vector<double> fronts_m;
    for (const auto& hit : hits) {
        if (hit && hit->front) {
            fronts_m.push_back(hit->distance_m);
        }
    }
    if (fronts_m.size() < kRoomHits) {
        return false;
    }
    const auto median = fronts_m.begin() + static_cast<std::ptrdiff_t>(fronts_m.size() / 2);
    std::nth_element(fronts_m.begin(), median, fronts_m.end());
    return *median >= kLeastMedian * 0.5 * diagonal_m;
}

} // namespace froxel::scene
