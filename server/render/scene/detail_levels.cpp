#include "render/scene/detail_levels.h"

#include "core/parallel.h"
#include "render/scene/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <meshoptimizer.h>
#include <optional>
#include <utility>

namespace froxel::render {
namespace {

// Of a group: more lock fewer edges, fewer follow the distance to the eye more closely.
constexpr size_t kGroupMeshlets = 16;
constexpr size_t kFewestMeshlets = 6; // what is left over joins a neighbour
// A group that keeps more of its triangles waits for other neighbours.
constexpr float kMostKept = 0.8F;

// Errors that are a smaller part of an edge are not told apart: what is so flat is cheap anyway.
constexpr float kErrorOfEdge = 1.0F / 64;
// For what lies between the points at which distances are taken, the mesh's vertices: by so much
// a distance may be larger there at most, and by this times their spacing over that of the coarse
// vertices.
constexpr float kMostMargin = 0.75F;
constexpr float kMarginOfSpacing = 3;
// A vertex of the mesh is given to a triangle that is so near to it, as a part of an edge or of how
// far the farthest are, or else to the nearest one.
constexpr float kNearOfEdge = 1.0F / 16;
constexpr float kNearOfMost = 0.25F;

constexpr uint32_t kNone = 0xffffffffU;

using Group = std::vector<uint32_t>; // meshlets

// Meshlets that share vertices, by place.
class Neighbours {
  public:
    struct Neighbour {
        uint32_t meshlet = 0;
        uint32_t shared = 0; // vertices
    };

    // places: of each vertex, equal where positions are. of(m): the indices of meshlet m.
    template <class IndicesOf>
    Neighbours(std::span<const uint32_t> places, size_t count, const IndicesOf& of)
        : lists_(count) {
        std::vector<uint32_t> last_at(places.size(), kNone); // meshlet at a place
        for (uint32_t m = 0; m < count; ++m) {
            for (const uint32_t vertex : of(m)) {
                uint32_t& last = last_at[places[vertex]];
                // Of all at a place each with the next, so that no list is longer than a meshlet's
                // vertices are many, even where all meet at one.
                if (last != m && last != kNone) {
                    add(m, last);
                    add(last, m);
                }
                last = m;
            }
        }
    }
    [[nodiscard]] std::span<const Neighbour> of(uint32_t meshlet) const { return lists_[meshlet]; }

  private:
    void add(uint32_t meshlet, uint32_t neighbour) {
        auto& list = lists_[meshlet];
        const auto known = std::ranges::find(list, neighbour, &Neighbour::meshlet);
        if (known == list.end()) {
            list.push_back({neighbour, 1});
        } else {
            ++known->shared;
        }
    }
    std::vector<std::vector<Neighbour>> lists_;
};

// Cuts meshlets into groups that have many vertices in common.
class Grouping {
  public:
    // order: of the meshlets, neighbours in space near to each other.
    Grouping(const Neighbours& neighbours, std::span<const uint32_t> order)
        : neighbours_(neighbours), order_(order), group_of_(order.size(), kNone),
          shared_(order.size(), 0) {
        while (const auto first = nextFree()) {
            grow(*first);
        }
        joinSmall();
    }
    std::vector<Group> groups;

  private:
    // The first in the order that is in no group.
    std::optional<uint32_t> nextFree() {
        while (next_ < order_.size() && group_of_[order_[next_]] != kNone) {
            ++next_;
        }
        return next_ < order_.size() ? std::optional(order_[next_]) : std::nullopt;
    }
    void take(uint32_t meshlet) {
        group_of_[meshlet] = static_cast<uint32_t>(groups.size() - 1);
        groups.back().push_back(meshlet);
        for (const auto& neighbour : neighbours_.of(meshlet)) {
            if (shared_[neighbour.meshlet] == 0) {
                candidates_.push_back(neighbour.meshlet);
            }
            shared_[neighbour.meshlet] += neighbour.shared;
        }
    }
    void grow(uint32_t first) {
        groups.emplace_back();
        take(first);
        while (groups.back().size() < kGroupMeshlets) {
            uint32_t best = kNone;
            for (const uint32_t candidate : candidates_) {
                if (group_of_[candidate] == kNone &&
                    (best == kNone || shared_[candidate] > shared_[best])) {
                    best = candidate;
                }
            }
            if (best == kNone) { // pieces that touch nothing: what is near in space
                const auto free = nextFree();
                if (!free || !candidates_.empty()) {
                    break;
                }
                best = *free;
            }
            take(best);
        }
        for (const uint32_t candidate : candidates_) {
            shared_[candidate] = 0;
        }
        candidates_.clear();
    }
    void joinSmall() {
        for (uint32_t g = 0; g < groups.size(); ++g) {
            if (groups[g].size() >= kFewestMeshlets) {
                continue;
            }
            uint32_t best = kNone;
            uint32_t most = 0;
            for (const uint32_t meshlet : groups[g]) {
                for (const auto& neighbour : neighbours_.of(meshlet)) {
                    const uint32_t other = group_of_[neighbour.meshlet];
                    if (other != g && neighbour.shared > most &&
                        groups[other].size() < 2 * kGroupMeshlets) {
                        most = neighbour.shared;
                        best = other;
                    }
                }
            }
            if (best != kNone) {
                for (const uint32_t meshlet : groups[g]) {
                    group_of_[meshlet] = best;
                    groups[best].push_back(meshlet);
                }
                groups[g].clear();
            }
        }
        std::erase_if(groups, [](const Group& group) { return group.empty(); });
    }

    const Neighbours& neighbours_;
    const std::span<const uint32_t> order_;
    size_t next_ = 0;
    std::vector<uint32_t> group_of_;
    std::vector<uint32_t> shared_; // vertices with the group that grows
    std::vector<uint32_t> candidates_;
};

// About both.
void addSphere(DetailError& sphere, const DetailError& other) {
    const float distance = glm::distance(sphere.center, other.center);
    if (distance + other.radius <= sphere.radius) {
        return;
    }
    if (distance + sphere.radius <= other.radius) {
        sphere.center = other.center;
        sphere.radius = other.radius;
        return;
    }
    const float radius = (distance + sphere.radius + other.radius) * 0.5F;
    sphere.center += (other.center - sphere.center) * ((radius - sphere.radius) / distance);
    sphere.radius = radius;
}

// What replaces a group.
struct Simplified {
    MeshletList list;
    DetailError error;
    std::vector<std::vector<uint32_t>> followers; // of each meshlet
};

float meanEdge(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
    float sum = 0;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        sum += glm::distance(positions[indices[i]], positions[indices[i + 1]]);
    }
    return sum / static_cast<float>(indices.size() / 3);
}

class LevelBuilder {
  public:
    LevelBuilder(std::span<const glm::vec3> positions,
                 std::span<const uint32_t> indices,
                 std::span<const Meshlet> meshlets)
        : positions_(positions), indices_(indices), exact_(meshlets), places_(positions.size()),
          followers_(meshlets.size()) {
        meshopt_generateVertexRemap(places_.data(), nullptr, positions.size(), positions.data(),
                                    positions.size(), sizeof(glm::vec3));
        out_.details.resize(meshlets.size());
        for (uint32_t m = 0; m < meshlets.size(); ++m) {
            out_.details[m].own = {meshlets[m].center, meshlets[m].radius, 0};
            current_.push_back(m);
        }
        std::vector<bool> seen(positions.size(), false);
        for (uint32_t m = 0; m < meshlets.size(); ++m) {
            for (const uint32_t vertex : indicesOf(m)) {
                if (!seen[vertex]) {
                    seen[vertex] = true;
                    followers_[m].push_back(vertex);
                }
            }
        }
        while (current_.size() > 1 && addLevel()) {
        }
    }
    [[nodiscard]] DetailLevels take() { return std::move(out_); }

  private:
    [[nodiscard]] const Meshlet& meshlet(uint32_t m) const {
        return m < exact_.size() ? exact_[m] : out_.coarser.meshlets[m - exact_.size()];
    }
    [[nodiscard]] std::span<const uint32_t> indicesOf(uint32_t m) const {
        const std::span<const uint32_t> all =
            m < exact_.size() ? indices_ : std::span<const uint32_t>(out_.coarser.indices);
        return all.subspan(meshlet(m).first_index, meshlet(m).index_count);
    }
    // Of current_, by number in it.
    [[nodiscard]] std::vector<Group> group() const {
        std::vector<glm::vec3> centers;
        centers.reserve(current_.size());
        for (const uint32_t m : current_) {
            centers.push_back(meshlet(m).center);
        }
        std::vector<uint32_t> rank(current_.size());
        meshopt_spatialSortRemap(rank.data(), &centers.front().x, centers.size(),
                                 sizeof(glm::vec3));
        std::vector<uint32_t> order(current_.size());
        for (uint32_t i = 0; i < rank.size(); ++i) {
            order[rank[i]] = i;
        }
        const Neighbours neighbours(places_, current_.size(),
                                    [&](uint32_t i) { return indicesOf(current_[i]); });
        return Grouping(neighbours, order).groups;
    }
    // Of each edge once, but of those on borders, which stay as they are.
    template <class Job>
    void eachEdgeMiddle(std::span<const uint32_t> indices, const Job& job) const {
        for (size_t i = 0; i < indices.size(); ++i) {
            const uint32_t a = indices[i];
            const uint32_t b = indices[i % 3 == 2 ? i - 2 : i + 1];
            if (a < b) {
                job((positions_[a] + positions_[b]) * 0.5F);
            }
        }
    }
    // Half of the group's triangles, or none where that cannot be.
    [[nodiscard]] std::optional<Simplified> simplified(const Group& group) const {
        std::vector<uint32_t> indices;
        for (const uint32_t i : group) {
            const auto some = indicesOf(current_[i]);
            indices.insert(indices.end(), some.begin(), some.end());
        }
        const LocalTriangles local = LocalTriangles::of(indices, positions_);
        std::vector<uint32_t> coarse(indices.size());
        const size_t count = meshopt_simplify(
            coarse.data(), local.indices.data(), local.indices.size(), &local.positions.front().x,
            local.positions.size(), sizeof(glm::vec3), indices.size() / 6 * 3,
            std::numeric_limits<float>::max(), meshopt_SimplifyLockBorder, nullptr);
        if (count == 0 ||
            static_cast<float>(count) > kMostKept * static_cast<float>(indices.size())) {
            return std::nullopt;
        }
        coarse.resize(count);
        Simplified out;
        out.list = cutIntoMeshlets(local, coarse);
        const float apart = follow(group, out);
        out.error = out_.details[current_[group.front()]].own;
        for (const uint32_t i : group) {
            const DetailError& own = out_.details[current_[i]].own;
            addSphere(out.error, own);
            out.error.error = std::max(out.error.error, own.error);
        }
        // Of the rounding of a sphere's middle, too.
        out.error.radius += kSlack * (out.error.radius + glm::length(out.error.center));
        out.error.error = std::max(out.error.error, apart);
        return out;
    }
    // How far the group's part of the mesh is from the coarser surface; the mesh's vertices go to
    // the coarser meshlets that they are near to. The other way needs no look: both surfaces end at
    // one border, so that the points of the mesh are nearest to every point of the other.
    [[nodiscard]] float follow(const Group& group, Simplified& to) const {
        const std::span<const uint32_t> coarse = to.list.indices;
        const SurfaceDistance surface(coarse, positions_);
        std::vector<uint32_t> meshlet_of; // triangle
        for (uint32_t m = 0; m < to.list.meshlets.size(); ++m) {
            meshlet_of.insert(meshlet_of.end(), to.list.meshlets[m].index_count / 3, m);
        }
        to.followers.resize(to.list.meshlets.size());
        const float edge = meanEdge(positions_, coarse);
        float most = kErrorOfEdge * edge;
        const float near = kNearOfEdge * edge;
        uint32_t triangle = 0;
        const auto look = [&](const glm::vec3& point, float enough) {
            const auto found = surface.nearest(point, enough, triangle);
            most = std::max(most, found.distance);
            triangle = found.triangle;
        };
        size_t vertex_count = 1;
        for (const uint32_t i : group) {
            vertex_count += followers_[current_[i]].size();
            for (const uint32_t vertex : followers_[current_[i]]) {
                look(positions_[vertex], std::max(near, kNearOfMost * most));
                to.followers[meshlet_of[triangle]].push_back(vertex);
            }
        }
        // Between its vertices the mesh itself matters as long as its edges are as long as these.
        for (const uint32_t i : group) {
            if (out_.details[current_[i]].own.error == 0) {
                eachEdgeMiddle(indicesOf(current_[i]),
                               [&](const glm::vec3& middle) { look(middle, most); });
            }
        }
        const auto coarse_vertices = static_cast<float>(coarse.size()) / 6;
        const float spacing = std::sqrt(coarse_vertices / static_cast<float>(vertex_count));
        return most * (1 + std::min(kMostMargin, kMarginOfSpacing * spacing));
    }
    // False: nothing more can be made coarser.
    bool addLevel() {
        const std::vector<Group> groups = group();
        std::vector<std::optional<Simplified>> made(groups.size());
        eachOnThreads(groups.size(), threadCount(groups.size(), 4),
                      [&](size_t g) { made[g] = simplified(groups[g]); });
        std::vector<uint32_t> next;
        for (size_t g = 0; g < groups.size(); ++g) {
            if (!made[g]) {
                for (const uint32_t i : groups[g]) {
                    next.push_back(current_[i]);
                }
                continue;
            }
            for (const uint32_t i : groups[g]) {
                out_.details[current_[i]].coarser = made[g]->error;
            }
            append(std::move(*made[g]), next);
            for (const uint32_t i : groups[g]) {
                followers_[current_[i]] = {};
            }
        }
        const bool coarser = next.size() < current_.size();
        current_ = std::move(next);
        return coarser;
    }
    void append(Simplified simplified, std::vector<uint32_t>& next) {
        render::append(out_.coarser, simplified.list);
        for (size_t i = 0; i < simplified.list.meshlets.size(); ++i) {
            next.push_back(static_cast<uint32_t>(out_.details.size()));
            out_.details.push_back({.own = simplified.error});
        }
        for (auto& followers : simplified.followers) {
            followers_.push_back(std::move(followers));
        }
    }

    static constexpr float kSlack = 1e-6F;
    std::span<const glm::vec3> positions_;
    std::span<const uint32_t> indices_;
    std::span<const Meshlet> exact_;
    std::vector<uint32_t> places_; // of vertices
    // Of each meshlet that nothing replaces yet: the mesh's vertices that it stands for.
    std::vector<std::vector<uint32_t>> followers_;
    std::vector<uint32_t> current_; // meshlets that nothing coarser replaces yet
    DetailLevels out_;
};

} // namespace

DetailLevels buildDetailLevels(std::span<const glm::vec3> positions,
                               std::span<const uint32_t> indices,
                               std::span<const Meshlet> meshlets) {
    return meshlets.empty() ? DetailLevels{} : LevelBuilder(positions, indices, meshlets).take();
}

} // namespace froxel::render
