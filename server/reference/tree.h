// Placed triangles in a tree of boxes, for rays in double.
#pragma once

#include "core/math.h"
#include "reference/rays.h"

#include <array>
#include <cstdint>
#include <vector>

namespace froxel::reference {

struct TreeTriangle {
    uint32_t instance = 0;
    uint32_t primitive = 0;
    uint32_t triangle = 0;
    Triangle placed;
};

// Immutable: any number of threads may ask.
class TriangleTree {
  public:
    explicit TriangleTree(std::vector<TreeTriangle> triangles);

    // Calls visit(triangle) for those whose boxes a ray meets on its way from 0 to `most`, in any
    // order, until one returns true; whether one did.
    template <class Visit>
    [[nodiscard]] bool any(const Ray& ray, double most, Visit visit) const;

  private:
    // A box around triangles [first, first + count), or around two children.
    struct Node {
        BoundsD3 box;
        uint32_t first = 0;
        uint32_t count = 0; // 0: inner
        uint32_t right = 0; // of an inner node; the left child comes next
    };
    static constexpr size_t kDeepest = 64;

    void build(uint32_t first, uint32_t count);
    [[nodiscard]] static bool
    meets(const BoundsD3& box, const Ray& ray, const glm::dvec3& inverse, double most);

    std::vector<TreeTriangle> triangles_;
    std::vector<Node> nodes_;
};

template <class Visit>
bool TriangleTree::any(const Ray& ray, double most, Visit visit) const {
    const glm::dvec3 inverse = 1.0 / ray.direction;
    std::array<uint32_t, kDeepest> stack{};
    size_t depth = 0;
    if (!nodes_.empty()) {
        stack[depth++] = 0;
    }
    while (depth > 0) {
        const uint32_t at = stack[--depth];
        const Node& node = nodes_[at];
        if (!meets(node.box, ray, inverse, most)) {
            continue;
        }
        if (node.count == 0) {
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (visit(triangles_[i])) {
                return true;
            }
        }
    }
    return false;
}

} // namespace froxel::reference
