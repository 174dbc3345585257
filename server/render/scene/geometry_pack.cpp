#include "render/scene/geometry_pack.h"

#include "core/ceil_divide.h"
#include "core/parallel.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <span>
#include <utility>

namespace froxel::render {

namespace {

// Small meshlets cull well and still amortise a draw; meshoptimizer wants a multiple of 4.
constexpr size_t kMeshletVertices = 96;
constexpr size_t kMeshletTriangles = 124;
constexpr float kConeWeight = 0.5F;

void packVertices(const scene::Primitive& source, const PackedPrimitive& at, PackedGeometry& out) {
    const auto first = static_cast<size_t>(at.vertex_offset);
    std::ranges::copy(source.positions, out.positions.begin() + at.vertex_offset);
    for (size_t i = 0; i < source.positions.size(); ++i) {
        out.surfaces[first + i] = {source.normals[i],
                                   source.uv0.empty() ? glm::vec2(0) : source.uv0[i]};
        if (at.extended) {
            out.extended[first + i] = {source.uv1.empty() ? glm::vec2(0) : source.uv1[i],
                                       source.colors.empty() ? glm::vec4(1) : source.colors[i],
                                       source.tangents.empty() ? glm::vec4(0) : source.tangents[i]};
        }
    }
}

// Triangles that one thread cuts into meshlets: those of a primitive, or some of them.
struct Part {
    const scene::Primitive* source = nullptr;
    PackedPrimitive* primitive = nullptr;
    std::vector<uint32_t> some; // indices; empty: all of the primitive's
    // What comes of them.
    std::vector<uint32_t> indices;
    std::vector<Meshlet> meshlets; // whose first_index is in these
};

// Cut into meshlets by themselves, with indices of their own, since meshoptimizer makes arrays of
// as many vertices as there are.
struct LocalTriangles {
    explicit LocalTriangles(const Part& part) {
        const auto& all = part.source->positions;
        if (part.some.empty()) {
            indices = part.source->indices;
            positions = all;
            return;
        }
        vertices = part.some;
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        owned_positions.reserve(vertices.size());
        for (const uint32_t vertex : vertices) {
            owned_positions.push_back(all[vertex]);
        }
        owned_indices.reserve(part.some.size());
        for (const uint32_t vertex : part.some) {
            owned_indices.push_back(static_cast<uint32_t>(
                std::ranges::lower_bound(vertices, vertex) - vertices.begin()));
        }
        indices = owned_indices;
        positions = owned_positions;
    }
    [[nodiscard]] uint32_t original(uint32_t local) const {
        return vertices.empty() ? local : vertices[local];
    }

    std::span<const uint32_t> indices;
    std::span<const glm::vec3> positions;

  private:
    std::vector<uint32_t> vertices; // the primitive's, where not all of them
    std::vector<uint32_t> owned_indices;
    std::vector<glm::vec3> owned_positions;
};

// Reorders triangles by meshlet.
void packTriangles(Part& part) {
    const LocalTriangles local(part);
    std::vector<uint32_t> ordered(local.indices.size());
    meshopt_optimizeVertexCache(ordered.data(), local.indices.data(), local.indices.size(),
                                local.positions.size());
    const size_t bound =
        meshopt_buildMeshletsBound(ordered.size(), kMeshletVertices, kMeshletTriangles);
    std::vector<meshopt_Meshlet> meshlets(bound);
    std::vector<uint32_t> vertices(bound * kMeshletVertices);
    std::vector<unsigned char> triangles(bound * kMeshletTriangles * 3);
    const float* positions = &local.positions.front().x;
    const size_t vertex_count = local.positions.size();
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(),
                                          ordered.data(), ordered.size(), positions, vertex_count,
                                          sizeof(glm::vec3), kMeshletVertices, kMeshletTriangles,
                                          kConeWeight));
    part.indices.reserve(ordered.size());
    part.meshlets.reserve(meshlets.size());
    for (const auto& meshlet : meshlets) {
        const auto bounds = meshopt_computeMeshletBounds(
            &vertices[meshlet.vertex_offset], &triangles[meshlet.triangle_offset],
            meshlet.triangle_count, positions, vertex_count, sizeof(glm::vec3));
        part.meshlets.push_back(
            {.first_index = static_cast<uint32_t>(part.indices.size()),
             .index_count = meshlet.triangle_count * 3,
             .center = {bounds.center[0], bounds.center[1], bounds.center[2]},
             .radius = bounds.radius,
             .cone_axis = {bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]},
             .cone_cutoff = bounds.cone_cutoff});
        for (size_t i = 0; i < meshlet.triangle_count * 3; ++i) {
            const unsigned char corner = triangles[meshlet.triangle_offset + i];
            part.indices.push_back(local.original(vertices[meshlet.vertex_offset + corner]));
        }
    }
}

// A primitive's triangles, cut where there are more of them than `most`: into neighbours, so that
// meshlets are as compact as those of all would be.
void addParts(const scene::Primitive& source,
              PackedPrimitive& primitive,
              size_t most,
              std::vector<Part>& parts) {
    const size_t triangle_count = source.indices.size() / 3;
    if (triangle_count <= most) {
        parts.push_back({&source, &primitive, {}, {}, {}});
        return;
    }
    std::vector<uint32_t> sorted(source.indices.size());
    meshopt_spatialSortTriangles(sorted.data(), source.indices.data(), source.indices.size(),
                                 &source.positions.front().x, source.positions.size(),
                                 sizeof(glm::vec3));
    const size_t count = ceilDivide(triangle_count, most);
    for (size_t i = 0; i < count; ++i) {
        const auto begin =
            sorted.begin() + static_cast<ptrdiff_t>(3 * (triangle_count * i / count));
        const auto end =
            sorted.begin() + static_cast<ptrdiff_t>(3 * (triangle_count * (i + 1) / count));
        parts.push_back({&source, &primitive, {begin, end}, {}, {}});
    }
}

PackedPrimitive describe(const scene::Primitive& source, size_t vertex_offset) {
    PackedPrimitive packed;
    packed.vertex_offset = static_cast<int32_t>(vertex_offset);
    packed.material = source.material;
    packed.extended = isExtended(source);
    packed.tangents = !source.tangents.empty();
    packed.center = source.bounds.center();
    packed.radius = glm::length(source.bounds.size()) * 0.5F;
    return packed;
}

// Starting a thread costs about as much as some thousands of triangles.
constexpr size_t kTrianglesPerThread = 16'384;

size_t threadsFor(size_t count, size_t triangle_count) {
    return std::clamp<size_t>(count, 1, threadCount(triangle_count, kTrianglesPerThread));
}

void appendParts(std::vector<Part> parts, PackedGeometry& out) {
    std::vector<std::pair<size_t, size_t>> firsts; // index and meshlet of each part
    size_t index_count = 0;
    size_t meshlet_count = 0;
    for (const Part& part : parts) {
        PackedPrimitive& primitive = *part.primitive;
        if (primitive.meshlet_count == 0) {
            primitive.first_index = static_cast<uint32_t>(index_count);
            primitive.first_meshlet = static_cast<uint32_t>(meshlet_count);
        }
        firsts.emplace_back(index_count, meshlet_count);
        index_count += part.indices.size();
        meshlet_count += part.meshlets.size();
        primitive.index_count += static_cast<uint32_t>(part.indices.size());
        primitive.meshlet_count += static_cast<uint32_t>(part.meshlets.size());
    }
    out.indices.resize(index_count);
    out.meshlets.resize(meshlet_count);
    eachOnThreads(parts.size(), threadsFor(parts.size(), index_count / 3), [&](size_t i) {
        Part& part = parts[i];
        const auto& [first_index, first_meshlet] = firsts[i];
        std::ranges::copy(part.indices, out.indices.begin() + static_cast<ptrdiff_t>(first_index));
        for (size_t m = 0; m < part.meshlets.size(); ++m) {
            out.meshlets[first_meshlet + m] = part.meshlets[m];
            out.meshlets[first_meshlet + m].first_index += static_cast<uint32_t>(first_index);
        }
        part = {};
    });
}

} // namespace

Corners fromLowest(Corners corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

bool isExtended(const scene::Primitive& primitive) {
    return !primitive.uv1.empty() || !primitive.colors.empty() || !primitive.tangents.empty();
}

PackedGeometry packGeometry(const scene::Scene& scene, size_t most_at_once) {
    PackedGeometry out;
    out.meshes.resize(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        out.meshes[m].resize(scene.meshes[m].primitives.size());
    }
    std::vector<std::pair<const scene::Primitive*, PackedPrimitive*>> primitives;
    std::vector<Part> parts;
    size_t vertex_count = 0;
    size_t extended_count = 0;
    size_t index_count = 0;
    for (const bool extended : {true, false}) {
        for (size_t m = 0; m < scene.meshes.size(); ++m) {
            for (size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
                const scene::Primitive& source = scene.meshes[m].primitives[p];
                if (isExtended(source) != extended) {
                    continue;
                }
                PackedPrimitive& packed = out.meshes[m][p];
                packed = describe(source, vertex_count);
                primitives.emplace_back(&source, &packed);
                vertex_count += source.positions.size();
                index_count += source.indices.size();
                if (!source.indices.empty()) {
                    addParts(source, packed, most_at_once, parts);
                }
            }
        }
        extended_count = extended ? vertex_count : extended_count;
    }
    out.positions.resize(vertex_count);
    out.surfaces.resize(vertex_count);
    out.extended.resize(extended_count);
    const size_t work = index_count / 3;
    eachOnThreads(primitives.size(), threadsFor(primitives.size(), work), [&](size_t i) {
        packVertices(*primitives[i].first, *primitives[i].second, out);
    });
    eachOnThreads(parts.size(), threadsFor(parts.size(), work),
                  [&](size_t i) { packTriangles(parts[i]); });
    appendParts(std::move(parts), out);
    return out;
}

} // namespace froxel::render
