#include "scene/stacked_layers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace froxel::scene {

namespace {

constexpr size_t kLines = 48;
constexpr uint64_t kMostSamples = uint64_t{1} << 17U;
// Of a part of the triangles: fewer that are met tell nothing of the others.
constexpr uint64_t kLeastMet = 8;

using Triangle = std::array<glm::dvec3, 3>; // world

struct Placed {
    const Instance* instance = nullptr;
    const Primitive* primitive = nullptr;
    uint64_t end = 0; // of its triangles, among all
};

std::vector<Placed> placedOf(const Scene& scene) {
    std::vector<Placed> placed;
    uint64_t end = 0;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            end += primitive.indices.size() / 3;
            placed.push_back({&instance, &primitive, end});
        }
    }
    return placed;
}

Triangle triangleOf(const Placed& placed, uint64_t back) {
    const auto& [instance, primitive, end] = placed;
    const size_t first = 3 * (primitive->indices.size() / 3 - back);
    Triangle triangle;
    for (size_t corner = 0; corner < 3; ++corner) {
        const glm::dvec3 at(primitive->positions[primitive->indices[first + corner]]);
        triangle[corner] = glm::dvec3(instance->world_from_object * glm::dvec4(at, 1));
    }
    return triangle;
}

std::vector<Triangle> sample(const Scene& scene, std::mt19937_64& dice, uint64_t& all) {
    const std::vector<Placed> placed = placedOf(scene);
    all = placed.empty() ? 0 : placed.back().end;
    const uint64_t count = std::min(all, kMostSamples);
    std::vector<Triangle> triangles;
    triangles.reserve(count);
    auto at = placed.begin();
    for (uint64_t i = 0; i < count; ++i) {
        // One of each of as many equal runs.
        const uint64_t begin = all / count * i + std::min(i, all % count);
        const uint64_t length = all / count + (i < all % count ? 1 : 0);
        const uint64_t chosen =
            begin + std::uniform_int_distribution<uint64_t>(0, length - 1)(dice);
        while (at->end <= chosen) {
            ++at;
        }
        triangles.push_back(triangleOf(*at, at->end - chosen));
    }
    return triangles;
}

// On both sides of `from`, or through an edge.
bool meets(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& along) {
    const glm::dvec3 a = triangle[0] - from;
    const glm::dvec3 b = triangle[1] - from;
    const glm::dvec3 c = triangle[2] - from;
    const double ab = glm::dot(along, glm::cross(a, b));
    const double bc = glm::dot(along, glm::cross(b, c));
    const double ca = glm::dot(along, glm::cross(c, a));
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

} // namespace

uint64_t stackedLayers(const Scene& scene) {
    std::mt19937_64 dice{std::random_device{}()};
    uint64_t all = 0;
    const std::vector<Triangle> triangles = sample(scene, dice, all);
    uint64_t most = 0;
    for (size_t line = 0; line < kLines && !triangles.empty(); ++line) {
        const size_t chosen = std::uniform_int_distribution<size_t>(0, triangles.size() - 1)(dice);
        const auto& [a, b, c] = triangles[chosen];
        const glm::dvec3 along = glm::cross(b - a, c - a);
        const glm::dvec3 from = (a + b + c) / 3.0;
        uint64_t met = 0;
        for (const Triangle& triangle : triangles) {
            met += meets(triangle, from, along) ? 1U : 0U;
        }
        const bool tells = triangles.size() == all || met >= kLeastMet;
        most = std::max(most, tells && along != glm::dvec3(0) ? met : 0);
    }
    return triangles.empty() ? 0 : most * all / triangles.size();
}

} // namespace froxel::scene
