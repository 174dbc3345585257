#include "scene/enclosing_sphere.h"

#include "scene/enclosure.h"

#include <algorithm>

namespace froxel::scene {

namespace {

// Vertices that are looked at; what is left then counts by the corners of its box.
constexpr uint64_t kMostVertices = uint64_t{1} << 26U;

struct Placed {
    const Primitive* primitive;
    const Instance* instance;
    double most_m = 0; // from the middle to its box's farthest corner

    [[nodiscard]] double distance(const glm::dvec3& middle, const glm::vec3& object) const {
        return glm::distance(middle,
                             glm::dvec3(instance->world_from_object * glm::dvec4(object, 1)));
    }
};

double farthestCorner(const Placed& placed, const glm::dvec3& middle) {
    const Bounds3& box = placed.primitive->bounds;
    double most_m = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 object((corner & 1U) != 0 ? box.max.x : box.min.x,
                               (corner & 2U) != 0 ? box.max.y : box.min.y,
                               (corner & 4U) != 0 ? box.max.z : box.min.z);
        most_m = std::max(most_m, placed.distance(middle, object));
    }
    return most_m;
}

} // namespace

settings::Sphere enclosingSphere(const Scene& scene) {
    const auto surround = surroundOf(scene);
    const glm::dvec3 middle = (surround ? surround->rest_world : scene.bounds_world).center();
    std::vector<Placed> all;
    for (const Instance& instance : scene.instances) {
        if (surround && &instance == &scene.instances[surround->instance]) {
            continue;
        }
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            if (!primitive.bounds.empty()) {
                all.push_back({&primitive, &instance});
                all.back().most_m = farthestCorner(all.back(), middle);
            }
        }
    }
    if (all.empty()) {
        return {};
    }
    std::sort(all.begin(), all.end(),
              [](const Placed& a, const Placed& b) { return a.most_m > b.most_m; });
    settings::Sphere sphere{middle, 0};
    uint64_t vertices = 0;
    for (const Placed& placed : all) {
        if (placed.most_m <= sphere.radius_m) {
            break;
        }
        vertices += placed.primitive->positions.size();
        if (vertices > kMostVertices) {
            sphere.radius_m = placed.most_m; // of all that are left the most
            break;
        }
        for (const glm::vec3& position : placed.primitive->positions) {
            sphere.radius_m = std::max(sphere.radius_m, placed.distance(middle, position));
        }
    }
    return sphere;
}

} // namespace froxel::scene
