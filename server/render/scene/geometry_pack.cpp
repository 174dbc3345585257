#include "render/scene/geometry_pack.h"

#include <algorithm>
#include <meshoptimizer.h>

namespace froxel::render {

namespace {

// Small meshlets cull well and still amortise a draw; meshoptimizer wants a multiple of 4.
constexpr size_t kMeshletVertices = 96;
constexpr size_t kMeshletTriangles = 124;
constexpr float kConeWeight = 0.5F;

void packVertices(const scene::Primitive& source, bool extended, PackedGeometry& out) {
    out.positions.insert(out.positions.end(), source.positions.begin(), source.positions.end());
    for (size_t i = 0; i < source.positions.size(); ++i) {
        out.surfaces.push_back(
            {source.normals[i], source.uv0.empty() ? glm::vec2(0) : source.uv0[i]});
        if (extended) {
            out.extended.push_back({source.uv1.empty() ? glm::vec2(0) : source.uv1[i],
                                    source.colors.empty() ? glm::vec4(1) : source.colors[i],
                                    source.tangents.empty() ? glm::vec4(0) : source.tangents[i]});
        }
    }
}

// Reorders the triangles by meshlet and appends indices and meshlets.
void packTriangles(const scene::Primitive& source, PackedPrimitive& packed, PackedGeometry& out) {
    std::vector<uint32_t> ordered(source.indices.size());
    meshopt_optimizeVertexCache(ordered.data(), source.indices.data(), source.indices.size(),
                                source.positions.size());
    const size_t bound =
        meshopt_buildMeshletsBound(ordered.size(), kMeshletVertices, kMeshletTriangles);
    std::vector<meshopt_Meshlet> meshlets(bound);
    std::vector<uint32_t> vertices(bound * kMeshletVertices);
    std::vector<unsigned char> triangles(bound * kMeshletTriangles * 3);
    meshlets.resize(
        meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(), ordered.data(),
                              ordered.size(), &source.positions.front().x, source.positions.size(),
                              sizeof(glm::vec3), kMeshletVertices, kMeshletTriangles, kConeWeight));
    packed.first_meshlet = static_cast<uint32_t>(out.meshlets.size());
    packed.meshlet_count = static_cast<uint32_t>(meshlets.size());
    for (const auto& meshlet : meshlets) {
        const auto bounds = meshopt_computeMeshletBounds(
            &vertices[meshlet.vertex_offset], &triangles[meshlet.triangle_offset],
            meshlet.triangle_count, &source.positions.front().x, source.positions.size(),
            sizeof(glm::vec3));
        out.meshlets.push_back(
            {.first_index = static_cast<uint32_t>(out.indices.size()),
             .index_count = meshlet.triangle_count * 3,
             .center = {bounds.center[0], bounds.center[1], bounds.center[2]},
             .radius = bounds.radius,
             .cone_axis = {bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]},
             .cone_cutoff = bounds.cone_cutoff});
        for (size_t i = 0; i < meshlet.triangle_count * 3; ++i) {
            const unsigned char local = triangles[meshlet.triangle_offset + i];
            out.indices.push_back(vertices[meshlet.vertex_offset + local]);
        }
    }
}

PackedPrimitive packPrimitive(const scene::Primitive& source, PackedGeometry& out) {
    PackedPrimitive packed;
    packed.vertex_offset = static_cast<int32_t>(out.positions.size());
    packed.first_index = static_cast<uint32_t>(out.indices.size());
    packed.material = source.material;
    packed.extended = isExtended(source);
    packed.tangents = !source.tangents.empty();
    packed.center = source.bounds.center();
    packed.radius = glm::length(source.bounds.size()) * 0.5F;
    packVertices(source, packed.extended, out);
    if (!source.indices.empty()) {
        packTriangles(source, packed, out);
    }
    packed.index_count = static_cast<uint32_t>(out.indices.size()) - packed.first_index;
    return packed;
}

} // namespace

Corners fromLowest(Corners corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

bool isExtended(const scene::Primitive& primitive) {
    return !primitive.uv1.empty() || !primitive.colors.empty() || !primitive.tangents.empty();
}

PackedGeometry packGeometry(const scene::Scene& scene) {
    PackedGeometry out;
    out.meshes.resize(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        out.meshes[m].resize(scene.meshes[m].primitives.size());
    }
    for (const bool extended : {true, false}) {
        for (size_t m = 0; m < scene.meshes.size(); ++m) {
            const auto& primitives = scene.meshes[m].primitives;
            for (size_t p = 0; p < primitives.size(); ++p) {
                if (isExtended(primitives[p]) == extended) {
                    out.meshes[m][p] = packPrimitive(primitives[p], out);
                }
            }
        }
    }
    return out;
}

} // namespace froxel::render
