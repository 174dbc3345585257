// How far points are from a surface of triangles.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

class SurfaceDistance {
  public:
    struct Found {
        float distance = 0;
        uint32_t triangle = 0;
    };

    // indices: 3 a triangle, at least one, into `positions`. Refers to both.
    SurfaceDistance(std::span<const uint32_t> indices, std::span<const glm::vec3> positions);

    // The triangle nearest to the point; or any one that is no farther than `enough`. first: a
    // triangle that is looked at before others. Any thread.
    [[nodiscard]] Found nearest(const glm::vec3& point, float enough, uint32_t first) const;

  private:
    // A box about triangles; a leaf's are order_[first] and following.
    struct Node {
        glm::vec3 low;
        glm::vec3 high;
        uint32_t first = 0;
        uint32_t count = 0;  // 0: no leaf
        uint32_t second = 0; // child; the other follows its parent
    };
    uint32_t build(uint32_t first, uint32_t end); // returns the node's place
    [[nodiscard]] glm::vec3 corner(uint32_t triangle, uint32_t i) const {
        return positions_[indices_[size_t{3} * triangle + i]];
    }
    [[nodiscard]] static float squaredToBox(const glm::vec3& point, const Node& node);
    [[nodiscard]] float squaredTo(uint32_t triangle, const glm::vec3& point) const;

    std::span<const uint32_t> indices_;
    std::span<const glm::vec3> positions_;
    std::vector<uint32_t> order_; // of triangles
    std::vector<Node> nodes_;
};

} // namespace froxel::render
