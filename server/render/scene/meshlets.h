// Triangles cut into meshlets: runs of neighbours that can be culled, and replaced, by themselves.
#pragma once

#include "interface/meshlet_io.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace froxel::render {

using io::Meshlet;

// Some of the triangles of a mesh by themselves, with indices of their own, since meshoptimizer
// makes arrays of as many vertices as there are.
struct LocalTriangles {
    // All of a mesh; refers to both.
    LocalTriangles(std::span<const uint32_t> all_indices, std::span<const glm::vec3> all_positions)
        : indices(all_indices), positions(all_positions) {}
    // Those of `some`: 3 indices each, into all_positions.
    [[nodiscard]] static LocalTriangles of(std::span<const uint32_t> some,
                                           std::span<const glm::vec3> all_positions);
    // Of `some`, 3 local indices each: those of them whose vertices have copies where many
    // triangles meet. No copies are made, and none given, where none has so many.
    [[nodiscard]] std::optional<LocalTriangles>
    withCopiesOfBusyVertices(std::span<const uint32_t> some) const;
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
    std::vector<uint32_t> words;   // Meshlet::first_word
    std::vector<Meshlet> meshlets;
};

// A meshlet of a list's words.
struct MeshletTriangles {
    MeshletTriangles(const Meshlet& meshlet, std::span<const uint32_t> words)
        : vertices(words.subspan(meshlet.first_word, meshlet.vertex_count)),
          triangles(
              words.subspan(meshlet.first_word + meshlet.vertex_count, meshlet.index_count / 3)) {}
    std::span<const uint32_t> vertices;
    std::span<const uint32_t> triangles;
};
// The number of a triangle's vertex; corner: 0 to 2.
[[nodiscard]] constexpr uint32_t localVertex(uint32_t triangle, uint32_t corner) {
    return triangle >> 8 * corner & 0xffU;
}

// The sizes of a list, or where a part of it begins.
struct MeshletPlace {
    size_t index = 0;
    size_t word = 0;
    size_t meshlet = 0;
};
[[nodiscard]] MeshletPlace endOf(const MeshletList& list);
// Adds the sizes of `part`.
[[nodiscard]] MeshletPlace behind(const MeshletPlace& at, const MeshletList& part);
void resize(MeshletList& list, const MeshletPlace& end);
// Copies a part to its place in a list that is large enough.
void copyTo(MeshletList& list, const MeshletPlace& at, const MeshletList& part);
void append(MeshletList& list, const MeshletList& part);

// The triangles, each once, with their winding. `indices`: 3 a triangle, into the vertices of
// `local`, which are the triangles' own or some of them. Pure.
[[nodiscard]] MeshletList cutIntoMeshlets(const LocalTriangles& local,
                                          std::span<const uint32_t> indices);

} // namespace froxel::render
