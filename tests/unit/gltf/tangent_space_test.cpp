// Tangents that a file does not have, as MikkTSpace makes them; mikktspace.mjs holds the same
// meshes against its author's code.
#include "gltf/tangent_space.h"
#include "scene/motion.h"
#include "scene/scene_check.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <numbers>
#include <random>

namespace froxel::gltf::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

using Triangle = std::array<uint32_t, 3>;

// On the plane z = 0, facing along z.
scene::Primitive flatMesh(std::vector<glm::vec3> positions,
                          std::vector<glm::vec2> uv,
                          std::vector<uint32_t> indices) {
    scene::Primitive mesh;
    mesh.normals.assign(positions.size(), {0, 0, 1});
    mesh.positions = std::move(positions);
    mesh.uv0 = std::move(uv);
    mesh.indices = std::move(indices);
    return mesh;
}

// A unit square of two triangles; v falls as y rises, as a texture stands upright.
scene::Primitive square() {
    return flatMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
                    {0, 1, 2, 0, 2, 3});
}

// Of a unit sphere of so many rings, u once around; its last column repeats the first with u = 1.
scene::Primitive sphere(uint32_t rings) {
    scene::Primitive mesh;
    const uint32_t columns = 2 * rings;
    for (uint32_t r = 0; r <= rings; ++r) {
        for (uint32_t c = 0; c <= columns; ++c) {
            const double theta = std::numbers::pi * r / rings;
            const double phi = 2 * std::numbers::pi * (c % columns) / columns;
            const double radius = r == rings ? 0 : std::sin(theta); // its poles are points
            const glm::vec3 p(radius * std::cos(phi), std::cos(theta), -radius * std::sin(phi));
            mesh.positions.push_back(p);
            mesh.normals.push_back(p);
            mesh.uv0.emplace_back(static_cast<float>(c) / static_cast<float>(columns),
                                  static_cast<float>(r) / static_cast<float>(rings));
        }
    }
    for (uint32_t r = 0; r < rings; ++r) {
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = r * (columns + 1) + c;
            const uint32_t b = a + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    return mesh;
}

// Corners that share few places, normals and coordinates in any way: seams, mirrors, folds, points
// and edges of many triangles.
scene::Primitive tangle(uint32_t seed) {
    std::minstd_rand random(seed);
    const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    const auto real = [&] { return static_cast<float>(random()) / 2147483648.0F * 2 - 1; };
    std::vector<glm::vec3> places(9);
    std::vector<glm::vec3> normals(4);
    std::vector<glm::vec2> coordinates(6);
    for (auto& p : places) {
        p = {real(), real(), real()};
    }
    for (auto& n : normals) {
        n = glm::normalize(glm::vec3(real(), real(), real()));
    }
    for (auto& uv : coordinates) {
        uv = {real(), real()};
    }
    scene::Primitive mesh;
    for (uint32_t i = 0; i < 14; ++i) {
        const uint32_t place = below(9);
        mesh.positions.push_back(places[place]);
        mesh.normals.push_back(normals[place % 4]);
        mesh.uv0.push_back(coordinates[below(3) == 0 ? below(6) : place % 6]);
    }
    for (uint32_t i = 0; i < 60; ++i) {
        mesh.indices.push_back(below(14));
    }
    return mesh;
}

TEST(TangentSpace, UprightTexture_HasItsTangentToTheRightAndItsBitangentUp) {
    const auto mesh = square();
    EXPECT_THAT(cornerTangents(mesh, mesh.uv0), Each(glm::vec4(1, 0, 0, 1)));
}

TEST(TangentSpace, MirroredTexture_TurnsTheTangentAndKeepsTheBitangent) {
    auto mesh = square();
    for (glm::vec2& uv : mesh.uv0) {
        uv.x = -uv.x;
    }
    EXPECT_THAT(cornerTangents(mesh, mesh.uv0), Each(glm::vec4(-1, 0, 0, -1)));
}

TEST(TangentSpace, MirrorLine_KeepsItsSidesApart) {
    // u rises to the line in the middle and falls behind it.
    auto mesh = flatMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}},
                         {{0, 1}, {1, 1}, {1, 0}, {0, 1}}, {0, 1, 2, 1, 3, 2});
    const auto corners = cornerTangents(mesh, mesh.uv0);
    const glm::vec4 left(1, 0, 0, 1);
    const glm::vec4 right(-1, 0, 0, -1);
    EXPECT_THAT(corners, ElementsAre(left, left, left, right, right, right));
    mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    EXPECT_THAT(addTangents(mesh, corners), ElementsAre(1, 2));
    EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 4, 3, 5));
    EXPECT_THAT(mesh.tangents, ElementsAre(left, left, left, right, right, right));
    EXPECT_EQ(mesh.positions[4], mesh.positions[1]);
    EXPECT_EQ(mesh.colors[5], mesh.colors[2]);
    EXPECT_EQ(mesh.uv0.size(), 6U);
    EXPECT_EQ(mesh.normals.size(), 6U);
    EXPECT_THAT(mesh.uv1, IsEmpty());
}

TEST(TangentSpace, Sphere_GoesAlongItsCirclesOfLatitude) {
    const auto mesh = sphere(24);
    const auto corners = cornerTangents(mesh, mesh.uv0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3& n = mesh.normals[mesh.indices[i]];
        EXPECT_NEAR(glm::length(glm::vec3(corners[i])), 1, 1e-6);
        EXPECT_NEAR(glm::dot(glm::vec3(corners[i]), n), 0, 1e-6);
        EXPECT_EQ(corners[i].w, 1);
        if (std::abs(n.y) < 0.99F) {
            const glm::vec3 east = glm::normalize(glm::vec3(n.z, 0, -n.x));
            EXPECT_GT(glm::dot(glm::vec3(corners[i]), east), 0.995F) << i;
        }
    }
}

// The square's second triangle has no coordinates of its own, or lies on a line.
TEST(TangentSpace, TriangleThatSaysNothing_TakesItsNeighbours) {
    auto mesh = flatMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                         {{0, 1}, {1, 1}, {1, 0}, {0.5F, 0.5F}}, {0, 1, 2, 0, 2, 3});
    auto corners = cornerTangents(mesh, mesh.uv0);
    EXPECT_EQ(corners[3], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(corners[4], glm::vec4(1, 0, 0, 1));
    mesh.indices = {0, 1, 2, 2, 2, 0};
    corners = cornerTangents(mesh, mesh.uv0);
    EXPECT_THAT(corners, Each(glm::vec4(1, 0, 0, 1)));
}

TEST(TangentSpace, NothingSaysAnything_IsAnyDirectionOnThePlane) {
    auto mesh = sphere(4);
    mesh.uv0.assign(mesh.positions.size(), glm::vec2(0.5F));
    for (const glm::vec2& uv : {glm::vec2(0.5F), glm::vec2(1e38F), glm::vec2(-1e-38F)}) {
        mesh.uv0.back() = uv;
        const auto corners = cornerTangents(mesh, mesh.uv0);
        for (size_t i = 0; i < corners.size(); ++i) {
            EXPECT_NEAR(glm::length(glm::vec3(corners[i])), 1, 1e-6);
            EXPECT_NEAR(glm::dot(glm::vec3(corners[i]), mesh.normals[mesh.indices[i]]), 0, 1e-6);
        }
    }
}

// What grows with the square of their number would take hours.
TEST(TangentSpace, ManyTrianglesOnOneVertexOrEdge_AreSoonDone) {
    constexpr uint32_t kCount = 200'000;
    scene::Primitive fan = flatMesh({{0, 0, 0}}, {{0, 0}}, {});
    for (uint32_t i = 0; i <= kCount; ++i) {
        const double angle = 1.0 * i / kCount;
        fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        fan.uv0.emplace_back(std::cos(7 * angle), std::sin(7 * angle));
        fan.normals.emplace_back(0, 0, 1);
        if (i > 0) {
            fan.indices.insert(fan.indices.end(), {0, i, i + 1});
        }
    }
    EXPECT_EQ(cornerTangents(fan, fan.uv0).size(), 3U * kCount);
    scene::Primitive loose = fan; // no two triangles share an edge
    for (uint32_t i = 0; i < kCount; i += 2) {
        std::swap(loose.indices[3 * i + 1], loose.indices[3 * i + 2]);
    }
    EXPECT_THAT(addTangents(loose, cornerTangents(loose, loose.uv0)), testing::Not(IsEmpty()));
    scene::Primitive edge = square();
    edge.indices.clear();
    for (uint32_t i = 0; i < kCount; ++i) {
        const bool odd = i % 2 == 1;
        edge.indices.insert(edge.indices.end(), {odd ? 1U : 0U, odd ? 0U : 1U, 2U + i % 2});
    }
    EXPECT_EQ(cornerTangents(edge, edge.uv0).size(), 3U * kCount);
}

// Writes what mikktspace.mjs reads.
TEST(TangentSpace, Meshes_ForTheOracle) {
    const char* folder = std::getenv("FROXEL_TANGENTS_FOLDER");
    Json meshes = Json::array();
    const auto add = [&](const std::string& name, const scene::Primitive& mesh) {
        Json out = {{"name", name}};
        const auto corners = cornerTangents(mesh, mesh.uv0);
        for (size_t i = 0; i < corners.size(); ++i) {
            const uint32_t at = mesh.indices[i];
            const auto put = [&](const char* stream, const auto& v) {
                for (int c = 0; c < v.length(); ++c) {
                    EXPECT_TRUE(std::isfinite(v[c])) << name;
                    out[stream].push_back(v[c]);
                }
            };
            put("positions", mesh.positions[at]);
            put("normals", mesh.normals[at]);
            put("uv", mesh.uv0[at]);
            put("tangents", corners[i]);
        }
        meshes.push_back(std::move(out));
    };
    add("square", square());
    add("sphere", sphere(8));
    for (uint32_t seed = 1; seed <= 200; ++seed) {
        add("tangle " + std::to_string(seed), tangle(seed));
    }
    if (folder != nullptr) {
        std::ofstream(std::filesystem::path(folder) / "meshes.json") << meshes;
    }
}

// A square with a normal map, upright, without tangents.
SceneFile normalMapped() {
    SceneFile file;
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 1, 1, 1, 0, 0}, 2);
    file.add("images", {{"uri", "missing.png"}});
    file.add("textures", {{"source", 0}});
    file.add("materials", {{"normalTexture", {{"index", 0}}}});
    file.primitive()["material"] = 0;
    return file;
}

std::vector<glm::vec4> tangentsOf(const SceneFile& file) {
    return loaded(file.load()).meshes.at(0).primitives.at(0).tangents;
}

// The picture of the map is missing, so that this is about the file's words alone.
TEST(TangentSpace, Reader_MakesThoseThatAMapAsksFor) {
    SceneFile file = normalMapped();
    EXPECT_THAT(tangentsOf(file),
                ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1)));
    file.attributes()["TANGENT"] =
        file.addAccessor<float>({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, 4);
    EXPECT_THAT(tangentsOf(file), Each(glm::vec4(0, 1, 0, -1))) << "the file's own";
    SceneFile plain = normalMapped();
    plain.json["materials"][0].erase("normalTexture");
    EXPECT_THAT(tangentsOf(plain), IsEmpty());
    plain.useExtension("KHR_materials_anisotropy");
    plain.json["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {
        {"anisotropyStrength", 1}, {"anisotropyTexture", {{"index", 0}}}};
    EXPECT_THAT(tangentsOf(plain), Each(glm::vec4(1, 0, 0, 1)));
}

TEST(TangentSpace, Reader_LeavesToTheShaderWhatTangentsWouldNotFollow) {
    const auto with = [](const Json& transform) {
        SceneFile file = normalMapped();
        file.useExtension("KHR_texture_transform");
        file.json["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] =
            transform;
        return tangentsOf(file);
    };
    EXPECT_THAT(with({{"offset", {0.5, 0.25}}, {"scale", {2, 3}}}), Each(glm::vec4(1, 0, 0, 1)));
    EXPECT_THAT(with({{"rotation", 0.5}}), IsEmpty());
    EXPECT_THAT(with({{"scale", {-1, 1}}}), IsEmpty());
    SceneFile file = normalMapped();
    file.primitive()["targets"] = Json::array({Json::object()});
    file.primitive()["targets"][0]["POSITION"] =
        file.addAccessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 0}, 3);
    file.json["meshes"][0]["weights"] = {0.5};
    EXPECT_THAT(tangentsOf(file), testing::SizeIs(3)) << "weights that stay";
}

// Vertices that are parted on a mirror line keep what bends them.
TEST(TangentSpace, Reader_GivesCopiesTheJointsOfTheirVertices) {
    SceneFile file = normalMapped();
    file.attributes()["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, 3);
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 1, 1, 1, 1, 0, 0, 1}, 2);
    file.primitive()["indices"] = file.addAccessor<uint16_t>({0, 1, 2, 1, 3, 2}, 1);
    file.attributes()["JOINTS_0"] =
        file.addAccessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 4);
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0}, 4);
    file.json["nodes"] = Json::parse(R"([{"mesh": 0, "skin": 0}, {}, {}])");
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    file.json["skins"] = Json::parse(R"([{"joints": [1, 2]}])");
    const auto scene = loaded(file.load());
    EXPECT_EQ(scene::findFault(scene), std::nullopt);
    ASSERT_TRUE(scene.motion);
    const auto& mesh = scene.meshes.at(0).primitives.at(0);
    const auto& bends = scene.motion->deformed.at(0).deformations.at(0);
    ASSERT_EQ(mesh.positions.size(), 6U);
    ASSERT_EQ(bends.first_influence.size(), 7U);
    EXPECT_THAT(bends.first_influence, ElementsAre(0, 1, 2, 4, 5, 6, 8));
    EXPECT_EQ(mesh.positions[4], mesh.positions[1]);
    EXPECT_EQ(bends.influences[5].joint, 1U);
    EXPECT_EQ(bends.influences[7].joint, 1U);
    EXPECT_EQ(bends.influences[7].weight, 0.5F);
}

} // namespace
} // namespace froxel::gltf::test
