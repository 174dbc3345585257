#include "reference/tree.h"

#include <algorithm>
#include <utility>

namespace froxel::reference {
namespace {

constexpr uint32_t kLeaf = 4;

glm::dvec3 middle(const Triangle& t) {
    return t.corner + (t.edge1 + t.edge2) / 3.0;
}

} // namespace

TriangleTree::TriangleTree(std::vector<TreeTriangle> triangles) : triangles_(std::move(triangles)) {
    if (!triangles_.empty()) {
        nodes_.reserve(triangles_.size());
        build(0, static_cast<uint32_t>(triangles_.size()));
    }
}

void TriangleTree::build(uint32_t first, uint32_t count) {
    const auto begin = triangles_.begin() + first;
    BoundsD3 box;
    BoundsD3 middles;
    for (auto at = begin; at != begin + count; ++at) {
        const Triangle& t = at->placed;
        box.add(t.corner);
        box.add(t.corner + t.edge1);
        box.add(t.corner + t.edge2);
        middles.add(middle(t));
    }
    const auto own = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({box, first, count, 0});
    if (count <= kLeaf) {
        return;
    }
    const glm::dvec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [axis](const auto& a, const auto& b) {
        return middle(a.placed)[axis] < middle(b.placed)[axis];
    });
    build(first, half);
    nodes_[own].right = static_cast<uint32_t>(nodes_.size());
    nodes_[own].count = 0;
    build(first + half, count - half);
}

bool TriangleTree::meets(const BoundsD3& box,
                         const Ray& ray,
                         const glm::dvec3& inverse,
                         double most) {
    double low = 0;
    double high = most;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - ray.origin[axis]) * inverse[axis];
        const double b = (box.max[axis] - ray.origin[axis]) * inverse[axis];
        if (a != a || b != b) { // in the plane of a side, along it
            continue;
        }
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    return low <= high * (1 + 1e-12) + 1e-12;
}

} // namespace froxel::reference
