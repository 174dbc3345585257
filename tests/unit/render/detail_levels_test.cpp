#include "render/scene/detail_levels.h"
#include "render/scene/surface_distance.h"
#include "support/ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

namespace froxel::render {
namespace {

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
};

using Bump = std::function<float(const glm::vec3& way)>;

float smooth(const glm::vec3& way) {
    return 1 + 0.1F * std::sin(9 * way.x) * std::sin(8 * way.y) * std::sin(7 * way.z);
}

// Folds steeper than 45 degrees.
float crumpled(const glm::vec3& way) {
    return smooth(way) + 0.03F * std::sin(60 * way.x) * std::sin(60 * way.y);
}

// As wide as its way is long: along the largest axis, exactly.
float cube(const glm::vec3& way) {
    const glm::vec3 size = glm::abs(way);
    return 1 / std::max({size.x, size.y, size.z});
}

Mesh ball(uint32_t rings, const Bump& bump, const glm::vec3& center = glm::vec3(0)) {
    test::Ball made = test::makeBall(rings, bump);
    for (glm::vec3& p : made.positions) {
        p += center;
    }
    return {std::move(made.positions), std::move(made.indices)};
}

// A square with a border.
Mesh sheet(uint32_t side, float height) {
    Mesh mesh;
    for (uint32_t y = 0; y <= side; ++y) {
        for (uint32_t x = 0; x <= side; ++x) {
            const glm::vec2 at = glm::vec2(x, y) / static_cast<float>(side);
            mesh.positions.push_back(
                {at.x, height * std::sin(9 * at.x) * std::sin(7 * at.y), at.y});
        }
    }
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x;
            const uint32_t b = a + side + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    }
    return mesh;
}

struct Levels {
    MeshletList exact;
    DetailLevels levels;
    [[nodiscard]] std::span<const uint32_t> indicesOf(size_t m) const {
        const bool is_exact = m < exact.meshlets.size();
        const MeshletList& list = is_exact ? exact : levels.coarser;
        const Meshlet& meshlet = list.meshlets[is_exact ? m : m - exact.meshlets.size()];
        return std::span(list.indices).subspan(meshlet.first_index, meshlet.index_count);
    }
};

Levels levelsOf(const Mesh& mesh) {
    Levels out;
    const LocalTriangles all(mesh.indices, mesh.positions);
    out.exact = cutIntoMeshlets(all, all.indices);
    out.levels = buildDetailLevels(mesh.positions, out.exact.indices, out.exact.meshlets);
    return out;
}

// Where errors may be larger the farther the surface is from the eye.
struct Eye {
    glm::vec3 at{0};
    float everywhere = 0;
    float per_metre = 0;
    [[nodiscard]] bool isEnough(const DetailError& detail) const {
        const float distance = std::max(glm::distance(at, detail.center) - detail.radius, 0.0F);
        return detail.error <= everywhere + per_metre * distance;
    }
};

std::vector<uint32_t> drawn(const Levels& levels, const Eye& eye) {
    std::vector<uint32_t> indices;
    for (size_t m = 0; m < levels.levels.details.size(); ++m) {
        const MeshletDetail& detail = levels.levels.details[m];
        if (eye.isEnough(detail.own) && !eye.isEnough(detail.coarser)) {
            const auto some = levels.indicesOf(m);
            indices.insert(indices.end(), some.begin(), some.end());
        }
    }
    return indices;
}

// Edges that triangles run along one way more often than the other.
std::set<std::pair<uint32_t, uint32_t>> openEdges(std::span<const uint32_t> indices) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = indices[i + k];
            const uint32_t b = indices[i + (k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    std::set<std::pair<uint32_t, uint32_t>> open;
    for (const auto& [edge, count] : edges) {
        if (count != 0) {
            open.insert(edge);
        }
    }
    return open;
}

// Of points all over either surface from the other.
float farthestApart(std::span<const glm::vec3> positions,
                    std::span<const uint32_t> one,
                    std::span<const uint32_t> other) {
    float farthest = 0;
    const auto look = [&](std::span<const uint32_t> from, std::span<const uint32_t> to) {
        const SurfaceDistance surface(to, positions);
        constexpr int kParts = 4;
        uint32_t triangle = 0;
        for (size_t i = 0; i + 2 < from.size(); i += 3) {
            for (int u = 0; u <= kParts; ++u) {
                for (int v = 0; u + v <= kParts; ++v) {
                    const float s = static_cast<float>(u) / kParts;
                    const float t = static_cast<float>(v) / kParts;
                    const glm::vec3 at = positions[from[i]] * (1 - s - t) +
                                         positions[from[i + 1]] * s + positions[from[i + 2]] * t;
                    const auto found = surface.nearest(at, farthest, triangle);
                    triangle = found.triangle;
                    farthest = std::max(farthest, found.distance);
                }
            }
        }
    };
    look(one, other);
    look(other, one);
    return farthest;
}

// Of the points that are looked at: of coordinates that large.
float rounding(const Mesh& mesh) {
    float largest = 0;
    for (const glm::vec3& p : mesh.positions) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest * 2.5e-7F;
}

std::vector<std::pair<std::string, Mesh>> meshes() {
    return {{"smooth", ball(48, smooth)}, {"crumpled", ball(64, crumpled)},
            {"cube", ball(48, cube)},     {"far away", ball(48, smooth, glm::vec3(1e4F, 0, -1e4F))},
            {"sheet", sheet(80, 0.1F)},   {"flat", sheet(80, 0)}};
}

TEST(DetailLevels, Surface_IsAsNearAsItsErrorSays) {
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const Levels levels = levelsOf(mesh);
        EXPECT_EQ(drawn(levels, {}), levels.exact.indices);
        size_t last = mesh.indices.size() + 1;
        for (const float error : {1e-3F, 3e-3F, 1e-2F, 3e-2F, 1e-1F, 1.0F}) {
            const auto indices = drawn(levels, {.everywhere = error});
            EXPECT_LE(farthestApart(mesh.positions, indices, levels.exact.indices),
                      error + rounding(mesh))
                << indices.size() / 3;
            EXPECT_LE(indices.size(), last);
            last = indices.size();
        }
        EXPECT_LE(last, mesh.indices.size() / 4);
    }
}

TEST(DetailLevels, Errors_GrowWithTheLevelsAndTheirSpheresHoldThem) {
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const Levels levels = levelsOf(mesh);
        for (size_t m = 0; m < levels.levels.details.size(); ++m) {
            const auto& [own, coarser] = levels.levels.details[m];
            EXPECT_EQ(own.error == 0, m < levels.exact.meshlets.size());
            EXPECT_GE(coarser.error, own.error);
            if (coarser.error < io::kNothingCoarser.error) {
                EXPECT_LE(glm::distance(own.center, coarser.center) + own.radius, coarser.radius);
            }
            for (const uint32_t vertex : levels.indicesOf(m)) {
                EXPECT_LE(glm::distance(mesh.positions[vertex], own.center),
                          own.radius * 1.0001F + 1e-3F);
            }
        }
    }
}

// Levels that meet leave no crack, and a border stays where it is.
TEST(DetailLevels, OpenEdges_AreTheMeshesOwnFromEveryEye) {
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const Levels levels = levelsOf(mesh);
        const auto border = openEdges(mesh.indices);
        std::mt19937 random(1);
        std::uniform_real_distribution<float> place(-3, 3);
        std::uniform_real_distribution<float> exponent(-5, 0);
        std::set<size_t> sizes;
        for (int i = 0; i < 60; ++i) {
            const Eye eye{mesh.positions.front() + glm::vec3(place(random), place(random), 0),
                          i % 2 == 0 ? 0 : std::pow(10.0F, exponent(random)),
                          std::pow(10.0F, exponent(random))};
            const auto indices = drawn(levels, eye);
            ASSERT_EQ(openEdges(indices), border) << i;
            sizes.insert(indices.size());
        }
        EXPECT_GE(sizes.size(), 5U);
    }
}

TEST(DetailLevels, SameMesh_GivesTheSame) {
    const Mesh mesh = ball(64, smooth);
    const Levels one = levelsOf(mesh);
    const Levels other = levelsOf(mesh);
    EXPECT_EQ(one.levels.coarser.indices, other.levels.coarser.indices);
    ASSERT_EQ(one.levels.details.size(), other.levels.details.size());
    for (size_t m = 0; m < one.levels.details.size(); ++m) {
        EXPECT_EQ(one.levels.details[m].coarser.error, other.levels.details[m].coarser.error);
    }
}

// Triangles by themselves have nothing but borders.
TEST(DetailLevels, LooseTriangles_HaveNoCoarserLevel) {
    Mesh mesh;
    for (uint32_t i = 0; i < 2000; ++i) {
        const glm::vec3 at(static_cast<float>(i % 40), static_cast<float>(i / 40), 0);
        for (const glm::vec3 corner :
             {glm::vec3(0), glm::vec3(0.9F, 0, 0), glm::vec3(0, 0.9F, 0)}) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(at + corner);
        }
    }
    const Levels levels = levelsOf(mesh);
    EXPECT_TRUE(levels.levels.coarser.meshlets.empty());
    EXPECT_EQ(levels.levels.details.size(), levels.exact.meshlets.size());
    EXPECT_EQ(drawn(levels, {.everywhere = 1e6F}), levels.exact.indices);
}

// Each is added to a ball: twice the same triangles, with either winding; a fin on an edge of two
// others; needles; triangles without an area; one that is huge.
TEST(DetailLevels, StrangeTriangles_AreKeptWithinTheError) {
    const Mesh plain = ball(40, smooth);
    const auto with = [&](const std::function<void(Mesh&)>& add) {
        Mesh mesh = plain;
        add(mesh);
        return mesh;
    };
    const std::vector<std::pair<std::string, Mesh>> strange = {
        {"twice", with([&](Mesh& m) {
             m.indices.insert(m.indices.end(), plain.indices.begin(), plain.indices.end());
         })},
        {"both sides", with([&](Mesh& m) {
             for (size_t i = 0; i < plain.indices.size(); i += 3) {
                 m.indices.insert(m.indices.end(),
                                  {plain.indices[i], plain.indices[i + 2], plain.indices[i + 1]});
             }
         })},
        {"fins", with([&](Mesh& m) {
             for (size_t i = 0; i < plain.indices.size(); i += 60) {
                 m.positions.push_back(plain.positions[plain.indices[i]] * 1.2F);
                 m.indices.insert(m.indices.end(), {plain.indices[i], plain.indices[i + 1],
                                                    static_cast<uint32_t>(m.positions.size()) - 1});
             }
         })},
        {"needles", with([&](Mesh& m) {
             for (auto& p : m.positions) {
                 p.y *= 1e-4F;
             }
         })},
        {"no area", with([&](Mesh& m) {
             for (uint32_t i = 0; i < 500; ++i) {
                 m.indices.insert(m.indices.end(), {i, i, i + 1, i, i, i});
             }
         })},
        {"huge", with([&](Mesh& m) {
             const auto first = static_cast<uint32_t>(m.positions.size());
             m.positions.insert(m.positions.end(), {{-1e6F, 0, 0}, {1e6F, 0, 0}, {0, 1e6F, 0}});
             m.indices.insert(m.indices.end(), {first, first + 1, first + 2});
         })}};
    for (const auto& [name, mesh] : strange) {
        SCOPED_TRACE(name);
        const Levels levels = levelsOf(mesh);
        EXPECT_EQ(drawn(levels, {}), levels.exact.indices);
        for (const float error : {1e-2F, 1e-1F, 10.0F}) {
            const auto indices = drawn(levels, {.everywhere = error});
            ASSERT_FALSE(indices.empty());
            EXPECT_LE(farthestApart(mesh.positions, indices, levels.exact.indices),
                      error + rounding(mesh));
        }
    }
}

TEST(SurfaceDistance, Nearest_IsThatOfAllTriangles) {
    const Mesh mesh = ball(12, crumpled);
    const SurfaceDistance surface(mesh.indices, mesh.positions);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-2, 2);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 point(place(random), place(random), place(random));
        float nearest = 1e9F;
        for (uint32_t t = 0; 3 * t < mesh.indices.size(); ++t) {
            const SurfaceDistance one(std::span(mesh.indices).subspan(size_t{3} * t, 3),
                                      mesh.positions);
            nearest = std::min(nearest, one.nearest(point, 0, 0).distance);
        }
        EXPECT_FLOAT_EQ(surface.nearest(point, 0, 0).distance, nearest);
        EXPECT_LE(surface.nearest(point, 0.5F, 7).distance, std::max(nearest, 0.5F));
    }
}

TEST(SurfaceDistance, Point_IsMeasuredToFaceEdgeAndCorner) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    const std::vector<uint32_t> indices = {0, 1, 2};
    const SurfaceDistance surface(indices, positions);
    const auto distance = [&](const glm::vec3& point) {
        return surface.nearest(point, 0, 0).distance;
    };
    EXPECT_FLOAT_EQ(distance({0.5F, 0.5F, 3}), 3);
    EXPECT_FLOAT_EQ(distance({1, -2, 0}), 2);
    EXPECT_FLOAT_EQ(distance({-3, 1, 4}), 5);
    EXPECT_FLOAT_EQ(distance({2, 2, 0}), std::sqrt(2.0F));
    EXPECT_FLOAT_EQ(distance({-3, -4, 0}), 5);
    EXPECT_FLOAT_EQ(distance({5, -4, 0}), 5);
    EXPECT_FLOAT_EQ(distance({-4, 5, 0}), 5);
}

// Degenerate ones, too, whichever is looked at first.
TEST(SurfaceDistance, TriangleWithoutArea_IsALineOrAPoint) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    for (const std::vector<uint32_t>& indices :
         {std::vector<uint32_t>{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 1, 2}, {2, 0, 1}, {1, 2, 0}}) {
        const SurfaceDistance line(indices, positions);
        EXPECT_FLOAT_EQ(line.nearest({1, 3, 0}, 0, 0).distance, 3);
        EXPECT_FLOAT_EQ(line.nearest({5, 0, 4}, 0, 0).distance, 5);
    }
    const std::vector<uint32_t> point = {1, 1, 1};
    EXPECT_FLOAT_EQ(SurfaceDistance(point, positions).nearest({2, 0, 7}, 0, 0).distance, 7);
}

// A hub that every meshlet has a corner at.
TEST(DetailLevels, FanOfManyMeshlets_HasLevelsWithinTheError) {
    Mesh mesh;
    mesh.positions.push_back({0, 0, 0});
    constexpr uint32_t kSpokes = 12'000;
    for (uint32_t i = 0; i < kSpokes; ++i) {
        const float turn = 6.2831853F * static_cast<float>(i) / kSpokes;
        mesh.positions.push_back({std::cos(turn), std::sin(turn), 0.1F * std::sin(9 * turn)});
        mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % kSpokes});
    }
    const Levels levels = levelsOf(mesh);
    for (const float error : {1e-3F, 1e-1F}) {
        const auto indices = drawn(levels, {.everywhere = error});
        EXPECT_LE(farthestApart(mesh.positions, indices, levels.exact.indices),
                  error + rounding(mesh));
    }
}

} // namespace
} // namespace froxel::render
