#include "gltf/tangent_space.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace froxel::gltf {
namespace {

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > double{std::numeric_limits<float>::min()} ? v / length : otherwise;
}

glm::dvec3 onPlane(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(normal, v);
}

glm::dvec3 anyOnPlane(const glm::dvec3& normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return unitOr(onPlane(axis, normal), axis);
}

// A number a vertex, equal where position, normal and coordinates are.
std::vector<uint32_t> welded(const scene::Primitive& primitive, std::span<const glm::vec2> uv) {
    using Key = std::array<uint32_t, 8>;
    struct Hash {
        size_t operator()(const Key& key) const {
            uint64_t hash = 0xcbf29ce484222325U; // FNV-1a over words
            for (const uint32_t word : key) {
                hash = (hash ^ word) * 0x100000001b3U;
            }
            return hash ^ (hash >> 32U);
        }
    };
    const auto bits = [](float x) { return std::bit_cast<uint32_t>(x + 0.0F); }; // -0 is 0
    std::unordered_map<Key, uint32_t, Hash> known;
    std::vector<uint32_t> numbers;
    numbers.reserve(primitive.positions.size());
    for (size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::vec3& p = primitive.positions[i];
        const glm::vec3& n = primitive.normals[i];
        const Key key = {bits(p.x), bits(p.y), bits(p.z),     bits(n.x),
                         bits(n.y), bits(n.z), bits(uv[i].x), bits(uv[i].y)};
        numbers.push_back(known.try_emplace(key, static_cast<uint32_t>(i)).first->second);
    }
    return numbers;
}

struct Face {
    std::array<uint32_t, 3> corners{}; // welded
    bool is_point_or_line = false;     // two corners are at one place: it says nothing
    bool says = false;                 // which way coordinates grow on it
    bool mirrored = false;
    glm::vec3 tangent{0}; // unit, in which u grows; of those that say
    std::array<uint32_t, 3> over{scene::kNone, scene::kNone,
                                 scene::kNone}; // faces across the edges from each corner
    std::array<uint32_t, 3> groups{scene::kNone, scene::kNone, scene::kNone};
};

class TangentSpace {
  public:
    TangentSpace(const scene::Primitive& primitive, std::span<const glm::vec2> uv)
        : primitive_(primitive) {
        const std::vector<uint32_t> vertices = welded(primitive, uv);
        faces_.resize(primitive.indices.size() / 3);
        for (size_t f = 0; f < faces_.size(); ++f) {
            for (size_t i = 0; i < 3; ++i) {
                faces_[f].corners[i] = vertices[primitive.indices[3 * f + i]];
            }
            derive(faces_[f], uv);
        }
        findNeighbours();
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            for (uint32_t i = 0; i < 3; ++i) {
                if (faces_[f].says && faces_[f].groups[i] == scene::kNone) {
                    fillGroup(f, i);
                }
            }
        }
    }

    [[nodiscard]] std::vector<glm::vec4> ofCorners() const {
        const std::vector<glm::dvec3> sums = sumGroups();
        std::unordered_map<uint32_t, glm::vec4> elsewhere; // of vertices, in the first face
        std::vector<glm::vec4> tangents;
        tangents.reserve(faces_.size() * 3);
        for (const Face& face : faces_) {
            for (size_t i = 0; i < 3; ++i) {
                const glm::dvec3 normal = normalOf(face.corners[i]);
                const uint32_t group = face.groups[i];
                const glm::dvec3 any = anyOnPlane(normal);
                const bool mirrored = group == scene::kNone || mirrored_[group];
                tangents.emplace_back(group == scene::kNone ? any : unitOr(sums[group], any),
                                      mirrored ? 1.0F : -1.0F);
                if (!face.is_point_or_line) {
                    elsewhere.try_emplace(face.corners[i], tangents.back());
                }
            }
        }
        for (size_t f = 0; f < faces_.size(); ++f) {
            for (size_t i = 0; faces_[f].is_point_or_line && i < 3; ++i) {
                const auto found = elsewhere.find(faces_[f].corners[i]);
                if (found != elsewhere.end()) {
                    tangents[3 * f + i] = found->second;
                }
            }
        }
        return tangents;
    }

  private:
    [[nodiscard]] glm::dvec3 positionOf(uint32_t vertex) const {
        return primitive_.positions[vertex];
    }
    [[nodiscard]] glm::dvec3 normalOf(uint32_t vertex) const { return primitive_.normals[vertex]; }

    void derive(Face& face, std::span<const glm::vec2> uv) const {
        const auto [a, b, c] = face.corners;
        const auto& at = primitive_.positions;
        face.is_point_or_line = at[a] == at[b] || at[b] == at[c] || at[c] == at[a];
        const glm::dvec2 u = glm::dvec2(uv[b]) - glm::dvec2(uv[a]);
        const glm::dvec2 v = glm::dvec2(uv[c]) - glm::dvec2(uv[a]);
        const double area = u.x * v.y - u.y * v.x;
        const glm::dvec3 first = positionOf(b) - positionOf(a);
        const glm::dvec3 second = positionOf(c) - positionOf(a);
        const glm::dvec3 along_u = v.y * first - u.y * second;
        const glm::dvec3 along_v = u.x * second - v.x * first;
        constexpr double kLeast = std::numeric_limits<float>::min();
        face.mirrored = area <= 0;
        face.says = !face.is_point_or_line && std::abs(area) > kLeast &&
                    glm::length(along_u) > kLeast && glm::length(along_v) > kLeast;
        face.tangent = glm::vec3(unitOr(face.mirrored ? -along_u : along_u, glm::dvec3(0)));
    }

    // Edges meet in pairs that run against each other, in the order of their faces.
    void findNeighbours() {
        struct Edge {
            uint32_t low;
            uint32_t high;
            uint32_t face;
            uint8_t corner; // that it begins at
            bool rises;
        };
        std::vector<Edge> edges;
        edges.reserve(faces_.size() * 3);
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            for (uint8_t i = 0; i < 3 && !faces_[f].is_point_or_line; ++i) {
                const uint32_t from = faces_[f].corners[i];
                const uint32_t to = faces_[f].corners[(i + 1U) % 3];
                edges.push_back({std::min(from, to), std::max(from, to), f, i, from < to});
            }
        }
        std::ranges::stable_sort(edges, [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, b.rises) < std::tie(b.low, b.high, a.rises);
        });
        const auto sameEnds = [](const Edge& a, const Edge& b) {
            return a.low == b.low && a.high == b.high;
        };
        for (size_t first = 0; first < edges.size();) {
            size_t falling = first;
            while (falling < edges.size() && sameEnds(edges[first], edges[falling]) &&
                   edges[falling].rises) {
                ++falling;
            }
            size_t end = falling;
            while (end < edges.size() && sameEnds(edges[first], edges[end])) {
                ++end;
            }
            for (size_t i = 0; first + i < falling && falling + i < end; ++i) {
                const Edge& a = edges[first + i];
                const Edge& b = edges[falling + i];
                faces_[a.face].over[a.corner] = b.face;
                faces_[b.face].over[b.corner] = a.face;
            }
            first = end;
        }
    }

    // All faces about a corner that can be reached from one to the next with the same winding of
    // coordinates. One without any takes the winding of the first that comes to it.
    void fillGroup(uint32_t face, uint32_t corner) {
        const auto group = static_cast<uint32_t>(mirrored_.size());
        const uint32_t vertex = faces_[face].corners[corner];
        const bool mirrored = faces_[face].mirrored;
        mirrored_.push_back(mirrored);
        std::vector<uint32_t> next = {face};
        while (!next.empty()) {
            const uint32_t f = next.back();
            next.pop_back();
            if (f == scene::kNone) {
                continue;
            }
            Face& reached = faces_[f];
            const auto found = std::ranges::find(reached.corners, vertex);
            const auto i = static_cast<size_t>(found - reached.corners.begin());
            if (i == 3 || reached.groups[i] != scene::kNone) {
                continue;
            }
            if (!reached.says && std::ranges::count(reached.groups, scene::kNone) == 3) {
                reached.mirrored = mirrored;
            }
            if (reached.mirrored != mirrored) {
                continue;
            }
            reached.groups[i] = group;
            next.push_back(reached.over[(i + 2) % 3]);
            next.push_back(reached.over[i]);
        }
    }

    // Each face counts by its angle, as the plane of the corner's normal sees it.
    [[nodiscard]] std::vector<glm::dvec3> sumGroups() const {
        std::vector<glm::dvec3> sums(mirrored_.size(), glm::dvec3(0));
        for (const Face& face : faces_) {
            for (size_t i = 0; i < 3; ++i) {
                if (!face.says || face.groups[i] == scene::kNone) {
                    continue;
                }
                const glm::dvec3 normal = normalOf(face.corners[i]);
                const glm::dvec3 place = positionOf(face.corners[i]);
                const auto edge = [&](uint32_t to) {
                    return unitOr(onPlane(positionOf(to) - place, normal), glm::dvec3(0));
                };
                const double cosine =
                    glm::dot(edge(face.corners[(i + 2) % 3]), edge(face.corners[(i + 1) % 3]));
                sums[face.groups[i]] +=
                    std::acos(std::clamp(cosine, -1.0, 1.0)) *
                    unitOr(onPlane(glm::dvec3(face.tangent), normal), glm::dvec3(0));
            }
        }
        return sums;
    }

    const scene::Primitive& primitive_;
    std::vector<Face> faces_;
    std::vector<bool> mirrored_; // of each group
};

template <class T>
void copy(std::vector<T>& stream, uint32_t vertex) {
    if (!stream.empty()) {
        stream.push_back(stream[vertex]);
    }
}

} // namespace

std::vector<glm::vec4> cornerTangents(const scene::Primitive& primitive,
                                      std::span<const glm::vec2> uv) {
    return TangentSpace(primitive, uv).ofCorners();
}

std::vector<uint32_t> addTangents(scene::Primitive& primitive,
                                  const std::vector<glm::vec4>& corner_tangents) {
    const size_t count = primitive.positions.size();
    primitive.tangents.assign(count, glm::vec4(0));
    std::vector<uint32_t> copies;
    std::map<std::pair<uint32_t, std::array<float, 4>>, uint32_t> known; // beside a vertex's first
    for (size_t corner = 0; corner < corner_tangents.size(); ++corner) {
        const glm::vec4& tangent = corner_tangents[corner];
        uint32_t& index = primitive.indices[corner];
        glm::vec4& first = primitive.tangents[index];
        if (first == glm::vec4(0)) {
            first = tangent;
        } else if (first != tangent) {
            const auto [found, fresh] =
                known.try_emplace({index, {tangent.x, tangent.y, tangent.z, tangent.w}},
                                  static_cast<uint32_t>(primitive.positions.size()));
            if (fresh) {
                copy(primitive.positions, index);
                copy(primitive.normals, index);
                copy(primitive.uv0, index);
                copy(primitive.uv1, index);
                copy(primitive.colors, index);
                primitive.tangents.push_back(tangent);
                copies.push_back(index);
            }
            index = found->second;
        }
    }
    for (size_t i = 0; i < primitive.tangents.size(); ++i) { // of vertices without a triangle
        if (primitive.tangents[i] == glm::vec4(0)) {
            primitive.tangents[i] = glm::vec4(anyOnPlane(primitive.normals[i]), 1);
        }
    }
    return copies;
}

} // namespace froxel::gltf
