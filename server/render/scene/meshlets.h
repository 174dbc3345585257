// Triangles cut into meshlets: runs of neighbours that can be culled, and replaced, by themselves.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

// A run of triangles with its bounding sphere and normal cone, in object space. All of its
// triangles face away from an eye where dot(normalize(center - eye), axis) >= cutoff + radius term;
// cone_cutoff of 1 means never (meshoptimizer, meshopt_computeMeshletBounds).
struct Meshlet {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    glm::vec3 center{0};
    float radius = 0;
    glm::vec3 cone_axis{0};
    float cone_cutoff = 1;
};

// Some of the triangles of a mesh by themselves, with indices of their own, since meshoptimizer
// makes arrays of as many vertices as there are.
struct LocalTriangles {
    // All of a mesh; refers to both.
    LocalTriangles(std::span<const uint32_t> all_indices, std::span<const glm::vec3> all_positions)
        : indices(all_indices), positions(all_positions) {}
    // Those of `some`: 3 indices each, into all_positions.
    [[nodiscard]] static LocalTriangles of(std::span<const uint32_t> some,
                                           std::span<const glm::vec3> all_positions);
    LocalTriangles(LocalTriangles&&) = default;
    LocalTriangles& operator=(LocalTriangles&&) = delete;

    // The mesh's own vertex.
    [[nodiscard]] uint32_t original(uint32_t local) const {
        return vertices_.empty() ? local : vertices_[local];
    }

    std::span<const uint32_t> indices;
    std::span<const glm::vec3> positions;

  private:
    LocalTriangles() = default;
    std::vector<uint32_t> vertices_; // the mesh's; empty: all of them
    std::vector<uint32_t> owned_indices_;
    std::vector<glm::vec3> owned_positions_;
};

struct MeshletList {
    std::vector<uint32_t> indices; // of the mesh's vertices, meshlet by meshlet
    std::vector<Meshlet> meshlets; // whose first_index is in these
};

// The triangles, each once, with their winding. `indices`: 3 a triangle, into the vertices of
// `local`, which are the triangles' own or some of them. Pure.
[[nodiscard]] MeshletList cutIntoMeshlets(const LocalTriangles& local,
                                          std::span<const uint32_t> indices);

} // namespace froxel::render
