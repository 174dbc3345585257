#include "render/scene/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace froxel::render {
namespace {

constexpr uint32_t kLeafTriangles = 4;

// The point of a triangle that is nearest to p (Ericson 2005, Real-Time Collision Detection,
// 5.1.5). Edges without a length, and triangles without an area, count as what they are part of.
glm::vec3
nearestOf(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const glm::vec3 ap = p - a;
    const float d1 = glm::dot(ab, ap);
    const float d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const glm::vec3 bp = p - b;
    const float d3 = glm::dot(ab, bp);
    const float d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) {
        return a + d1 / (d1 - d3) * ab;
    }
    const glm::vec3 cp = p - c;
    const float d5 = glm::dot(ab, cp);
    const float d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) {
        return a + d2 / (d2 - d6) * ac;
    }
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6 && d4 - d3 + d5 - d6 > 0) {
        return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
    }
    const float whole = va + vb + vc;
    return whole > 0 ? a + vb / whole * ab + vc / whole * ac : a;
}

} // namespace

SurfaceDistance::SurfaceDistance(std::span<const uint32_t> indices,
                                 std::span<const glm::vec3> positions)
    : indices_(indices), positions_(positions), order_(indices.size() / 3) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(order_.size());
    build(0, static_cast<uint32_t>(order_.size()));
}

uint32_t SurfaceDistance::build(uint32_t first, uint32_t end) {
    const auto at = static_cast<uint32_t>(nodes_.size());
    Node node{corner(order_[first], 0), corner(order_[first], 0), first, end - first, 0};
    for (uint32_t i = first; i < end; ++i) {
        for (uint32_t k = 0; k < 3; ++k) {
            node.low = glm::min(node.low, corner(order_[i], k));
            node.high = glm::max(node.high, corner(order_[i], k));
        }
    }
    nodes_.push_back(node);
    if (end - first <= kLeafTriangles) {
        return at;
    }
    const glm::vec3 size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [&](uint32_t triangle) {
        return corner(triangle, 0)[axis] + corner(triangle, 1)[axis] + corner(triangle, 2)[axis];
    };
    const uint32_t middle = (first + end) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
    nodes_[at].count = 0;
    build(first, middle);
    nodes_[at].second = build(middle, end);
    return at;
}

float SurfaceDistance::squaredToBox(const glm::vec3& point, const Node& node) {
    const glm::vec3 beyond = glm::max(glm::max(node.low - point, point - node.high), glm::vec3(0));
    return glm::dot(beyond, beyond);
}

float SurfaceDistance::squaredTo(uint32_t triangle, const glm::vec3& point) const {
    // From the point: far from the origin single precision is coarse.
    const glm::vec3 offset = nearestOf(glm::vec3(0), corner(triangle, 0) - point,
                                       corner(triangle, 1) - point, corner(triangle, 2) - point);
    return glm::dot(offset, offset);
}

SurfaceDistance::Found
SurfaceDistance::nearest(const glm::vec3& point, float enough, uint32_t first) const {
    float squared = squaredTo(first, point);
    uint32_t triangle = first;
    struct Waiting {
        uint32_t node;
        float squared; // of its box
    };
    std::array<Waiting, 64> stack; // the tree is balanced
    uint32_t depth = 0;
    stack[depth++] = {0, 0};
    while (depth > 0 && squared > enough * enough) {
        const Waiting next = stack[--depth];
        if (!(next.squared < squared)) {
            continue;
        }
        const Node& node = nodes_[next.node];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const float found = squaredTo(order_[i], point);
            if (found < squared) {
                squared = found;
                triangle = order_[i];
            }
        }
        if (node.count == 0) {
            const uint32_t first_child = next.node + 1;
            const Waiting one{first_child, squaredToBox(point, nodes_[first_child])};
            const Waiting other{node.second, squaredToBox(point, nodes_[node.second])};
            const bool one_first = one.squared <= other.squared;
            stack[depth++] = one_first ? other : one;
            stack[depth++] = one_first ? one : other;
        }
    }
    return {std::sqrt(squared), triangle};
}

} // namespace froxel::render
