#include "render/scene/geometry_pack.h"

#include "core/ceil_divide.h"
#include "core/parallel.h"
#include "core/text.h"
#include "render/scene/geometry_cache.h"
#include "scene/motion.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <meshoptimizer.h>
#include <span>
#include <utility>

namespace froxel::render {

namespace {

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
    MeshletList cut;            // what comes of them
};

void packTriangles(Part& part) {
    const scene::Primitive& source = *part.source;
    const LocalTriangles local = part.some.empty()
                                     ? LocalTriangles(source.indices, source.positions)
                                     : LocalTriangles::of(part.some, source.positions);
    part.cut = cutIntoMeshlets(local, local.indices);
}

// A primitive's triangles, cut where there are more of them than `most`: into neighbours, so that
// meshlets are as compact as those of all would be.
void addParts(const scene::Primitive& source,
              PackedPrimitive& primitive,
              size_t most,
              std::vector<Part>& parts) {
    const size_t triangle_count = source.indices.size() / 3;
    if (triangle_count <= most) {
        parts.push_back({&source, &primitive, {}, {}});
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
        parts.push_back({&source, &primitive, {begin, end}, {}});
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
    std::vector<MeshletPlace> places;
    MeshletPlace end;
    for (const Part& part : parts) {
        PackedPrimitive& primitive = *part.primitive;
        if (primitive.meshlet_count == 0) {
            primitive.first_index = static_cast<uint32_t>(end.index);
            primitive.first_meshlet = static_cast<uint32_t>(end.meshlet);
        }
        places.push_back(end);
        end = behind(end, part.cut);
        primitive.index_count += static_cast<uint32_t>(part.cut.indices.size());
        primitive.meshlet_count += static_cast<uint32_t>(part.cut.meshlets.size());
    }
    resize(out.triangles, end);
    eachOnThreads(parts.size(), threadsFor(parts.size(), end.index / 3), [&](size_t i) {
        copyTo(out.triangles, places[i], parts[i].cut);
        parts[i] = {};
    });
}

void appendCoarserLevels(const scene::Scene& scene, PackedGeometry& out) {
    const std::vector<bool> bent = bentMeshes(scene);
    const std::span<const Meshlet> exact = out.triangles.meshlets;
    MeshletList coarser;
    out.details.resize(exact.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        for (size_t p = 0; p < out.meshes[m].size() && !bent[m]; ++p) {
            PackedPrimitive& primitive = out.meshes[m][p];
            const DetailLevels levels =
                buildDetailLevels(scene.meshes[m].primitives[p].positions, out.triangles.indices,
                                  exact.subspan(primitive.first_meshlet, primitive.meshlet_count));
            const auto of_coarser = levels.details.begin() + primitive.meshlet_count;
            std::copy(levels.details.begin(), of_coarser,
                      out.details.begin() + primitive.first_meshlet);
            out.details.insert(out.details.end(), of_coarser, levels.details.end());
            primitive.first_coarser_meshlet =
                static_cast<uint32_t>(exact.size() + coarser.meshlets.size());
            primitive.coarser_meshlet_count = static_cast<uint32_t>(levels.coarser.meshlets.size());
            append(coarser, levels.coarser);
        }
    }
    if (coarser.meshlets.empty()) {
        out.details.clear();
    }
    append(out.triangles, coarser);
}

// Of a scene, in the order of their vertices.
using Primitives = std::vector<std::pair<const scene::Primitive*, PackedPrimitive*>>;

Primitives packVertices(const scene::Scene& scene, PackedGeometry& out) {
    out.meshes.resize(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        out.meshes[m].resize(scene.meshes[m].primitives.size());
    }
    Primitives primitives;
    size_t vertex_count = 0;
    for (const bool extended : {true, false}) {
        for (size_t m = 0; m < scene.meshes.size(); ++m) {
            for (size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
                const scene::Primitive& source = scene.meshes[m].primitives[p];
                if (isExtended(source) == extended) {
                    out.meshes[m][p] = describe(source, vertex_count);
                    primitives.emplace_back(&source, &out.meshes[m][p]);
                    vertex_count += source.positions.size();
                }
            }
        }
        if (extended) {
            out.extended.resize(vertex_count);
        }
    }
    out.positions.resize(vertex_count);
    out.surfaces.resize(vertex_count);
    eachOnThreads(primitives.size(), threadsFor(primitives.size(), vertex_count), [&](size_t i) {
        packVertices(*primitives[i].first, *primitives[i].second, out);
    });
    return primitives;
}

size_t triangleCount(const Primitives& primitives) {
    size_t count = 0;
    for (const auto& [source, packed] : primitives) {
        count += source->indices.size() / 3;
    }
    return count;
}

void packTriangles(const scene::Scene& scene,
                   const Primitives& primitives,
                   const PackOptions& options,
                   PackedGeometry& out) {
    std::vector<Part> parts;
    for (const auto& [source, packed] : primitives) {
        if (!source->indices.empty()) {
            addParts(*source, *packed, options.most_at_once, parts);
        }
    }
    eachOnThreads(parts.size(), threadsFor(parts.size(), triangleCount(primitives)),
                  [&](size_t i) { packTriangles(parts[i]); });
    appendParts(std::move(parts), out);
    if (options.detail_levels) {
        appendCoarserLevels(scene, out);
    }
}

} // namespace

Corners fromLowest(Corners corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

bool isExtended(const scene::Primitive& primitive) {
    return !primitive.uv1.empty() || !primitive.colors.empty() || !primitive.tangents.empty();
}

std::vector<bool> bentMeshes(const scene::Scene& scene) {
    std::vector<bool> bent(scene.meshes.size(), false);
    if (scene.motion) {
        for (const scene::DeformedMesh& deformed : scene.motion->deformed) {
            bent[deformed.mesh] = true;
        }
    }
    return bent;
}

PackedGeometry packGeometry(const scene::Scene& scene, const PackOptions& options) {
    PackedGeometry out;
    const Primitives primitives = packVertices(scene, out);
    if (options.cache_folder.empty() ||
        triangleCount(primitives) < options.least_cached_triangles) {
        packTriangles(scene, primitives, options, out);
        return out;
    }
    const GeometryHash hash = hashOfGeometry(scene, options);
    const auto file = geometryCacheFile(options.cache_folder, hash);
    if (!readGeometry(file, hash, scene, out)) {
        packTriangles(scene, primitives, options, out);
        if (const auto written = writeGeometry(file, hash, out); !written) {
            spdlog::warn("event=geometry_not_kept reason={}", logValue(written.error().message));
        }
    }
    return out;
}

} // namespace froxel::render
