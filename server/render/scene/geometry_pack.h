// Meshes as the GPU reads them: three vertex streams, one index list, cut into meshlets that can be
// culled by themselves.
#pragma once

#include "render/scene/detail_levels.h"
#include "render/scene/meshlets.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace froxel::render {

struct SurfaceVertex {
    glm::vec3 normal;
    glm::vec2 uv0;
};
static_assert(sizeof(SurfaceVertex) == 20);

struct ExtendedVertex {
    glm::vec2 uv1;
    glm::vec4 color;
    glm::vec4 tangent;
};
static_assert(sizeof(ExtendedVertex) == 40);

// A primitive's part of PackedGeometry::triangles.
struct TriangleRanges {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    uint32_t first_meshlet = 0;
    uint32_t meshlet_count = 0;
    // Of coarser levels, which replace those; 0: none.
    uint32_t first_coarser_meshlet = 0;
    uint32_t coarser_meshlet_count = 0;
};

struct PackedPrimitive : TriangleRanges {
    int32_t vertex_offset = 0;
    uint32_t material = 0;
    bool extended = false; // has ExtendedVertex data
    bool tangents = false; // that data's tangents are from the file
    glm::vec3 center{0};   // bounding sphere, object space
    float radius = 0;
};

// Extended vertices come first, so that all streams share vertex offsets.
struct PackedGeometry {
    std::vector<glm::vec3> positions;
    std::vector<SurfaceVertex> surfaces;
    std::vector<ExtendedVertex> extended;
    MeshletList triangles;              // the scene's; then those of coarser levels
    std::vector<MeshletDetail> details; // of each meshlet; empty: there are no coarser levels
    std::vector<std::vector<PackedPrimitive>> meshes; // as in scene::Scene::meshes
};

// A triangle's corners from the lowest on: packing may begin a triangle with another corner, but
// keeps its winding.
using Corners = std::array<uint32_t, 3>;
[[nodiscard]] Corners fromLowest(Corners corners);

// Whether the primitive has ExtendedVertex data.
[[nodiscard]] bool isExtended(const scene::Primitive& primitive);
// Of each mesh, whether an instance bends it.
[[nodiscard]] std::vector<bool> bentMeshes(const scene::Scene& scene);

// Meshlets of a primitive of more triangles than that are made of so many at once, of neighbours:
// on several threads, and their bounds are others than those of all at once would be. The same
// scene gives the same result.
inline constexpr size_t kMostTrianglesAtOnce = 500'000;

struct PackOptions {
    size_t most_at_once = kMostTrianglesAtOnce;
    bool detail_levels = false; // of meshes that no instance bends
    // Where what takes long is kept from run to run (geometry_cache.h), of scenes with so many
    // triangles; empty: nowhere.
    std::filesystem::path cache_folder{};
    size_t least_cached_triangles = 500'000;
};

[[nodiscard]] PackedGeometry packGeometry(const scene::Scene& scene,
                                          const PackOptions& options = {});

} // namespace froxel::render
