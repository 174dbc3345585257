// Meshes as the GPU reads them: three vertex streams, one index list, cut into meshlets that can be
// culled by themselves.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
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

struct PackedPrimitive {
    int32_t vertex_offset = 0;
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    uint32_t first_meshlet = 0;
    uint32_t meshlet_count = 0;
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
    std::vector<uint32_t> indices;
    std::vector<Meshlet> meshlets;
    std::vector<std::vector<PackedPrimitive>> meshes; // as in scene::Scene::meshes
};

// A triangle's corners from the lowest on: packing may begin a triangle with another corner, but
// keeps its winding.
using Corners = std::array<uint32_t, 3>;
[[nodiscard]] Corners fromLowest(Corners corners);

// Whether the primitive has ExtendedVertex data.
[[nodiscard]] bool isExtended(const scene::Primitive& primitive);

// Meshlets of a primitive of more triangles than that are made of so many at once, of neighbours:
// on several threads, and their bounds are others than those of all at once would be. The same
// scene gives the same result.
inline constexpr size_t kMostTrianglesAtOnce = 500'000;

[[nodiscard]] PackedGeometry packGeometry(const scene::Scene& scene,
                                          size_t most_at_once = kMostTrianglesAtOnce);

} // namespace froxel::render
