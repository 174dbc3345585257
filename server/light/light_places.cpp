#include "light/light_places.h"

#include "light/hash.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace froxel::light {
namespace {

struct Triangle {
    glm::dvec3 corner;
    glm::dvec3 side_a;
    glm::dvec3 side_b;
    glm::dvec3 normal;
    double area;
    bool two_sided;
};

// Calls visit(const scene::Instance&, const scene::Primitive&).
template <class Visit>
void eachPrimitive(const scene::Scene& scene, const Visit& visit) {
    for (const scene::Instance& instance : scene.instances) {
        if (instance.mesh < scene.meshes.size()) {
            for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
                visit(instance, primitive);
            }
        }
    }
}

// What is meant: by its material and its triangles' normals.
struct Wanted {
    bool unlit;
    double least_up; // the normal's y
};
constexpr Wanted kCarriers{true, -0.25}; // ceilings over lamps have none
constexpr Wanted kLit{false, -1};

// Calls visit(const Triangle&) for each `stride`-th, if it is wanted.
template <class Visit>
void eachTriangle(const scene::Scene& scene,
                  const Wanted& wanted,
                  uint64_t stride,
                  const Visit& visit) {
    uint64_t skip = 0; // triangles, to the next that is looked at
    eachPrimitive(scene, [&](const auto& instance, const scene::Primitive& primitive) {
        const bool has_material = primitive.material < scene.materials.size();
        const bool unlit = has_material && scene.materials[primitive.material].unlit;
        const bool two_sided = has_material && scene.materials[primitive.material].double_sided;
        if (unlit && !wanted.unlit) {
            return;
        }
        const glm::dmat4& placed = instance.world_from_object;
        const double side = glm::determinant(glm::dmat3(placed)) < 0 ? -1 : 1;
        const auto corner = [&](size_t i) { // not finite where the index leads nowhere
            const uint32_t index = primitive.indices[i];
            const glm::dvec3 object = index < primitive.positions.size()
                                          ? glm::dvec3(primitive.positions[index])
                                          : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
            return glm::dvec3(placed * glm::dvec4(object, 1));
        };
        const uint64_t count = primitive.indices.size() / 3;
        uint64_t i = skip;
        for (; i < count; i += stride) {
            const glm::dvec3 first = corner(3 * i);
            const glm::dvec3 a = corner(3 * i + 1) - first;
            const glm::dvec3 b = corner(3 * i + 2) - first;
            const glm::dvec3 cross = side * glm::cross(a, b);
            const double twice = glm::length(cross);
            if (twice > 0 && std::isfinite(twice) && cross.y >= wanted.least_up * twice) {
                visit(Triangle{first, a, b, cross / twice, twice / 2, two_sided});
            }
        }
        skip = i - count;
    });
}

uint64_t triangleCount(const scene::Scene& scene) {
    uint64_t count = 0;
    eachPrimitive(scene, [&](const auto& /*instance*/, const scene::Primitive& primitive) {
        count += primitive.indices.size() / 3;
    });
    return count;
}

// Evenly over it: a parallelogram, folded along its diagonal.
glm::dvec3 pointOf(const Triangle& triangle, double u, double v) {
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return triangle.corner + u * triangle.side_a + v * triangle.side_b;
}

std::vector<LightPlace> placesOn(const scene::Scene& scene, const Wanted& wanted) {
    const uint64_t stride = 1 + triangleCount(scene) / kMostTriangles;
    double total = 0;
    eachTriangle(scene, wanted, stride, [&](const Triangle& triangle) { total += triangle.area; });
    std::vector<LightPlace> places;
    if (!(total > 0) || !std::isfinite(total)) {
        return places;
    }
    places.reserve(kLightPlaces);
    // One place in each of equal parts of the area, anywhere within it.
    const double part = total / kLightPlaces;
    const auto numbersOf = [](size_t place) { return Fractions(mix(place + 1)).values; };
    double passed = 0;
    eachTriangle(scene, wanted, stride, [&](const Triangle& triangle) {
        passed += triangle.area;
        while (places.size() < kLightPlaces) {
            const auto numbers = numbersOf(places.size());
            if ((static_cast<double>(places.size()) + numbers[0]) * part >= passed) {
                return;
            }
            places.push_back(
                {pointOf(triangle, numbers[1], numbers[2]), triangle.normal, triangle.two_sided});
        }
    });
    return places;
}

} // namespace

std::vector<LightPlace> lightPlaces(const scene::Scene& scene) {
    return placesOn(scene, kCarriers);
}

std::vector<LightPlace> litPlaces(const scene::Scene& scene) {
    return placesOn(scene, kLit);
}

} // namespace froxel::light
