#include "render/scene/geometry_pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace froxel::render {

namespace {

scene::Primitive fan(uint32_t count, bool colored) {
    scene::Primitive p;
    p.positions.push_back({0, 0, 0});
    for (uint32_t i = 0; i <= count; ++i) {
        const auto t = static_cast<float>(i);
        p.positions.push_back({std::cos(t), std::sin(t), t * 0.01F});
    }
    for (uint32_t i = 0; i < count; ++i) {
        p.indices.insert(p.indices.end(), {0, i + 1, i + 2});
    }
    for (const auto& position : p.positions) {
        p.normals.push_back({0, 0, 1});
        p.bounds.add(position);
    }
    if (colored) {
        p.colors.assign(p.positions.size(), glm::vec4(0.5F));
    }
    return p;
}

using Triangle = std::array<uint32_t, 3>;

std::vector<Triangle> sortedTriangles(std::span<const uint32_t> indices) {
    std::vector<Triangle> out;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        Triangle t = {indices[i], indices[i + 1], indices[i + 2]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end()); // keeps the winding
        out.push_back(t);
    }
    std::sort(out.begin(), out.end());
    return out;
}

void expectWordsAreIndices(const MeshletList& list) {
    for (const Meshlet& meshlet : list.meshlets) {
        const MeshletTriangles words(meshlet, list.words);
        for (uint32_t i = 0; i < meshlet.index_count; ++i) {
            const uint32_t local = localVertex(words.triangles[i / 3], i % 3);
            ASSERT_LT(local, words.vertices.size());
            EXPECT_EQ(words.vertices[local], list.indices[meshlet.first_index + i]);
        }
    }
}

} // namespace

TEST(GeometryPack, Meshlets_CoverEveryTriangleOnceWithItsWinding) {
    scene::Scene scene;
    scene.meshes.push_back({"fan", {fan(500, false)}});
    const auto packed = packGeometry(scene);
    const auto& p = packed.meshes[0][0];
    EXPECT_EQ(sortedTriangles(packed.triangles.indices),
              sortedTriangles(scene.meshes[0].primitives[0].indices));
    uint32_t next = p.first_index;
    for (const auto& meshlet : packed.triangles.meshlets) {
        EXPECT_EQ(meshlet.first_index, next);
        next += meshlet.index_count;
        for (uint32_t i = 0; i < meshlet.index_count; ++i) {
            const auto& at = packed.positions[packed.triangles.indices[meshlet.first_index + i]];
            EXPECT_LE(glm::distance(at, meshlet.center), meshlet.radius * 1.0001F + 1e-6F);
        }
    }
    EXPECT_EQ(next, p.first_index + p.index_count);
    EXPECT_GT(packed.triangles.meshlets.size(), 1U);
    expectWordsAreIndices(packed.triangles);
}

// Hours, if its work grew with the square of them.
TEST(GeometryPack, MillionTrianglesAroundOneVertex_AreCutSoon) {
    scene::Scene scene;
    scene.meshes.push_back({"fan", {fan(1'000'000, false)}});
    const auto packed = packGeometry(scene);
    EXPECT_EQ(sortedTriangles(packed.triangles.indices),
              sortedTriangles(scene.meshes[0].primitives[0].indices));
    expectWordsAreIndices(packed.triangles);
}

TEST(GeometryPack, HalfAMillionTrianglesInOnePlace_AreCutSoon) {
    scene::Primitive apart;
    scene::Primitive shared;
    shared.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (uint32_t i = 0; i < 500'000; ++i) {
        apart.positions.insert(apart.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        apart.indices.insert(apart.indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
        shared.indices.insert(shared.indices.end(), {0, 1, 2});
    }
    for (scene::Primitive* primitive : {&apart, &shared}) {
        primitive->normals.assign(primitive->positions.size(), glm::vec3(0, 0, 1));
        scene::Scene scene;
        scene.meshes.push_back({"heap", {*primitive}});
        const auto packed = packGeometry(scene);
        EXPECT_EQ(sortedTriangles(packed.triangles.indices), sortedTriangles(primitive->indices));
        expectWordsAreIndices(packed.triangles);
    }
}

TEST(GeometryPack, ManyTriangles_AreCutIntoPartsThatCoverEachOnce) {
    scene::Scene scene;
    scene.meshes.push_back({"fans", {fan(40, false), fan(900, false), fan(41, true)}});
    const auto packed = packGeometry(scene, {.most_at_once = 100});
    const auto again = packGeometry(scene, {.most_at_once = 100});
    EXPECT_EQ(packed.triangles.indices, again.triangles.indices);
    EXPECT_EQ(packed.triangles.words, again.triangles.words);
    expectWordsAreIndices(packed.triangles);
    uint32_t next_meshlet = 0;
    for (const size_t p : {2U, 0U, 1U}) { // in the order of vertices
        SCOPED_TRACE(p);
        const auto& primitive = packed.meshes[0][p];
        const auto& source = scene.meshes[0].primitives[p];
        const auto indices = std::span(packed.triangles.indices)
                                 .subspan(primitive.first_index, primitive.index_count);
        EXPECT_EQ(sortedTriangles(indices), sortedTriangles(source.indices));
        EXPECT_EQ(primitive.first_meshlet, next_meshlet);
        next_meshlet += primitive.meshlet_count;
        EXPECT_GE(primitive.meshlet_count, source.indices.size() / 300);
        uint32_t next = primitive.first_index;
        for (const auto& meshlet : std::span(packed.triangles.meshlets)
                                       .subspan(primitive.first_meshlet, primitive.meshlet_count)) {
            EXPECT_EQ(meshlet.first_index, next);
            EXPECT_LE(meshlet.index_count, 300U);
            next += meshlet.index_count;
            for (uint32_t i = 0; i < meshlet.index_count; ++i) {
                const auto& at =
                    source.positions[packed.triangles.indices[meshlet.first_index + i]];
                EXPECT_LE(glm::distance(at, meshlet.center), meshlet.radius * 1.0001F + 1e-6F);
            }
        }
        EXPECT_EQ(next, primitive.first_index + primitive.index_count);
        for (size_t i = 0; i < source.positions.size(); ++i) {
            const size_t at = static_cast<size_t>(primitive.vertex_offset) + i;
            EXPECT_EQ(packed.positions[at], source.positions[i]);
            EXPECT_EQ(packed.surfaces[at].normal, source.normals[i]);
        }
    }
    EXPECT_EQ(next_meshlet, packed.triangles.meshlets.size());
}

TEST(GeometryPack, ExtendedPrimitives_ComeFirst_SoThatStreamsShareOffsets) {
    scene::Scene scene;
    scene.meshes.push_back({"plain", {fan(5, false)}});
    scene.meshes.push_back({"colored", {fan(7, true)}});
    const auto packed = packGeometry(scene);
    EXPECT_EQ(packed.extended.size(), scene.meshes[1].primitives[0].positions.size());
    EXPECT_EQ(packed.meshes[1][0].vertex_offset, 0);
    EXPECT_TRUE(packed.meshes[1][0].extended);
    EXPECT_FALSE(packed.meshes[0][0].extended);
    EXPECT_EQ(packed.surfaces.size(), packed.positions.size());
}

} // namespace froxel::render
