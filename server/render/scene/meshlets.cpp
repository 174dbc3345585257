#include "render/scene/meshlets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <meshoptimizer.h>
#include <numeric>

namespace froxel::render {
namespace {

using io::kMeshletTriangles;
using io::kMeshletVertices;
static_assert(kMeshletTriangles % 4 == 0, "meshoptimizer wants it so");
constexpr float kConeWeight = 0.5F;

constexpr uint32_t kFree = 0xffffffffU;
// The work of meshoptimizer grows with the square of the triangles that meet at a vertex: two
// million around one would take hours.
constexpr uint32_t kMostAroundVertex = 512;

// Likewise of the triangles that have one middle: its tree of them does not part those.
constexpr uint32_t kMostOfOneMiddle = 4096;

// As cutIntoMeshlets(), of few triangles around each vertex and of few with one middle.
MeshletList cutFew(const LocalTriangles& local, std::span<const uint32_t> indices) {
    std::vector<uint32_t> ordered(indices.size());
    meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(),
                                local.positions.size());
    const size_t bound =
        meshopt_buildMeshletsBound(ordered.size(), kMeshletVertices, kMeshletTriangles);
    std::vector<meshopt_Meshlet> meshlets(bound);
    std::vector<uint32_t> vertices(bound * size_t{kMeshletVertices});
    std::vector<unsigned char> triangles(bound * size_t{kMeshletTriangles} * 3);
    const float* positions = &local.positions.front().x;
    const size_t vertex_count = local.positions.size();
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(),
                                          ordered.data(), ordered.size(), positions, vertex_count,
                                          sizeof(glm::vec3), kMeshletVertices, kMeshletTriangles,
                                          kConeWeight));
    MeshletList list;
    list.indices.reserve(ordered.size());
    list.words.reserve(ordered.size() / 3 * 2);
    list.meshlets.reserve(meshlets.size());
    for (const auto& meshlet : meshlets) {
        const auto bounds = meshopt_computeMeshletBounds(
            &vertices[meshlet.vertex_offset], &triangles[meshlet.triangle_offset],
            meshlet.triangle_count, positions, vertex_count, sizeof(glm::vec3));
        list.meshlets.push_back(
            {.first_index = static_cast<uint32_t>(list.indices.size()),
             .index_count = meshlet.triangle_count * 3,
             .first_word = static_cast<uint32_t>(list.words.size()),
             .vertex_count = meshlet.vertex_count,
             .center = {bounds.center[0], bounds.center[1], bounds.center[2]},
             .radius = bounds.radius,
             .cone_axis = {bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]},
             .cone_cutoff = bounds.cone_cutoff});
        for (size_t i = 0; i < meshlet.vertex_count; ++i) {
            list.words.push_back(local.original(vertices[meshlet.vertex_offset + i]));
        }
        for (size_t i = 0; i < meshlet.triangle_count; ++i) {
            uint32_t triangle = 0;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t corner = triangles[meshlet.triangle_offset + 3 * i + k];
                list.indices.push_back(local.original(vertices[meshlet.vertex_offset + corner]));
                triangle |= corner << 8 * k;
            }
            list.words.push_back(triangle);
        }
    }
    return list;
}

// Likewise of any number around a vertex.
MeshletList cut(const LocalTriangles& local, std::span<const uint32_t> indices) {
    const auto split = local.withCopiesOfBusyVertices(indices);
    return split ? cutFew(*split, split->indices) : cutFew(local, indices);
}

// Whether more triangles than kMostOfOneMiddle may have the same middle; never no where they have.
bool middlesCoincide(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
    constexpr size_t kBuckets = size_t{1} << 16U;
    const size_t count = indices.size() / 3;
    if (count <= kMostOfOneMiddle) {
        return false;
    }
    std::vector<uint32_t> buckets(kBuckets); // triangles by their middles' hashes
    for (size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 sum =
            positions[indices[i]] + positions[indices[i + 1]] + positions[indices[i + 2]];
        const auto bits = std::bit_cast<std::array<uint32_t, 3>>(sum + 0.0F); // of -0, too
        const uint64_t mixed = (bits[0] * 0x9e3779b97f4a7c15U) ^ (bits[1] * 0xc2b2ae3d27d4eb4fU) ^
                               (bits[2] * 0x165667b19e3779f9U);
        ++buckets[(mixed * 0x9e3779b97f4a7c15U) >> 48U];
    }
    return std::ranges::max(buckets) > kMostOfOneMiddle + 4 * count / kBuckets;
}

// Few triangles at a time, in their order.
MeshletList cutInRuns(const LocalTriangles& local, std::span<const uint32_t> indices) {
    MeshletList list;
    for (size_t begin = 0; begin < indices.size(); begin += size_t{3} * kMostOfOneMiddle) {
        const auto run =
            indices.subspan(begin, std::min(size_t{3} * kMostOfOneMiddle, indices.size() - begin));
        const auto part = LocalTriangles::of(run, local.positions);
        MeshletList made = cut(part, part.indices);
        for (uint32_t& index : made.indices) {
            index = local.original(index);
        }
        for (const Meshlet& meshlet : made.meshlets) {
            for (uint32_t i = 0; i < meshlet.vertex_count; ++i) {
                uint32_t& vertex = made.words[meshlet.first_word + i];
                vertex = local.original(vertex);
            }
        }
        append(list, made);
    }
    return list;
}

} // namespace

LocalTriangles LocalTriangles::of(std::span<const uint32_t> some,
                                  std::span<const glm::vec3> all_positions) {
    LocalTriangles local;
    // In the order of their first use. A hash table with linear probing, at most half full.
    const size_t places = std::bit_ceil(2 * some.size());
    const auto placeOf = [&](uint32_t vertex) {
        return size_t{vertex} * 0x9e3779b97f4a7c15U >> (64 - std::countr_zero(places));
    };
    std::vector<uint32_t> table(places, kFree); // local vertices
    local.owned_indices_.reserve(some.size());
    for (const uint32_t vertex : some) {
        size_t place = placeOf(vertex);
        while (table[place] != kFree && local.vertices_[table[place]] != vertex) {
            place = (place + 1) % places;
        }
        if (table[place] == kFree) {
            table[place] = static_cast<uint32_t>(local.vertices_.size());
            local.vertices_.push_back(vertex);
            local.owned_positions_.push_back(all_positions[vertex]);
        }
        local.owned_indices_.push_back(table[place]);
    }
    local.indices = local.owned_indices_;
    local.positions = local.owned_positions_;
    return local;
}

std::optional<LocalTriangles>
LocalTriangles::withCopiesOfBusyVertices(std::span<const uint32_t> some) const {
    if (some.size() / 3 <= kMostAroundVertex) {
        return {};
    }
    std::vector<uint32_t> uses(positions.size());
    for (const uint32_t vertex : some) {
        ++uses[vertex];
    }
    if (std::ranges::max(uses) <= kMostAroundVertex) {
        return {};
    }
    LocalTriangles split;
    split.owned_positions_.assign(positions.begin(), positions.end());
    for (uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
        split.vertices_.push_back(original(vertex));
    }
    std::ranges::fill(uses, 0U);
    std::vector<uint32_t> copies = split.vertices_; // the newest of each
    std::iota(copies.begin(), copies.end(), 0U);
    for (const uint32_t vertex : some) {
        if (++uses[vertex] % kMostAroundVertex == 0) {
            copies[vertex] = static_cast<uint32_t>(split.vertices_.size());
            split.vertices_.push_back(original(vertex));
            split.owned_positions_.push_back(positions[vertex]);
        }
        split.owned_indices_.push_back(copies[vertex]);
    }
    split.indices = split.owned_indices_;
    split.positions = split.owned_positions_;
    return split;
}

MeshletList cutIntoMeshlets(const LocalTriangles& local, std::span<const uint32_t> indices) {
    return middlesCoincide(local.positions, indices) ? cutInRuns(local, indices)
                                                     : cut(local, indices);
}

MeshletPlace endOf(const MeshletList& list) {
    return behind({}, list);
}

MeshletPlace behind(const MeshletPlace& at, const MeshletList& part) {
    return {at.index + part.indices.size(), at.word + part.words.size(),
            at.meshlet + part.meshlets.size()};
}

void resize(MeshletList& list, const MeshletPlace& end) {
    list.indices.resize(end.index);
    list.words.resize(end.word);
    list.meshlets.resize(end.meshlet);
}

void copyTo(MeshletList& list, const MeshletPlace& at, const MeshletList& part) {
    const auto copy = [](const auto& from, auto& to, size_t first) {
        std::ranges::copy(from, to.begin() + static_cast<ptrdiff_t>(first));
    };
    copy(part.indices, list.indices, at.index);
    copy(part.words, list.words, at.word);
    for (size_t i = 0; i < part.meshlets.size(); ++i) {
        Meshlet& meshlet = list.meshlets[at.meshlet + i];
        meshlet = part.meshlets[i];
        meshlet.first_index += static_cast<uint32_t>(at.index);
        meshlet.first_word += static_cast<uint32_t>(at.word);
    }
}

void append(MeshletList& list, const MeshletList& part) {
    const MeshletPlace at = endOf(list);
    resize(list, behind(at, part));
    copyTo(list, at, part);
}

} // namespace froxel::render
