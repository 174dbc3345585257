// Vertex streams, indices and topologies.
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::gltf {
namespace {

using test::Bytes;
using test::bytesOf;
using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using testing::ElementsAre;
using testing::HasSubstr;

scene::Primitive onlyPrimitive(const SceneFile& file) {
    const scene::Scene scene = loaded(file.load());
    if (scene.meshes.size() != 1 || scene.meshes[0].primitives.size() != 1) {
        ADD_FAILURE() << "no single primitive";
        return {};
    }
    return scene.meshes[0].primitives[0];
}

// Gives the triangle's corners normals so that its vertices stay shared.
void addNormals(SceneFile& file, size_t count = 3) {
    std::vector<float> normals;
    for (size_t i = 0; i < count; ++i) {
        normals.insert(normals.end(), {0, 0, 2});
    }
    file.attributes()["NORMAL"] = file.addAccessor<float>(normals, 3);
}

// Four corners of a square, for strips and fans.
SceneFile square() {
    SceneFile file;
    file.attributes()["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
    addNormals(file, 4);
    return file;
}

TEST(Geometry, NonIndexedTriangle_CountsUp) {
    SceneFile file;
    addNormals(file);
    const scene::Primitive primitive = onlyPrimitive(file);
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
    EXPECT_EQ(primitive.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1)) << "made unit";
    EXPECT_EQ(primitive.bounds.min, glm::vec3(0));
    EXPECT_EQ(primitive.bounds.max, glm::vec3(1, 1, 0));
}

template <class T>
class IndexType : public testing::Test {};
using IndexTypes = testing::Types<uint8_t, uint16_t, uint32_t>;
TYPED_TEST_SUITE(IndexType, IndexTypes);

TYPED_TEST(IndexType, Read_GivesTheIndices) {
    SceneFile file;
    addNormals(file);
    file.primitive()["indices"] = file.addAccessor<TypeParam>({2, 0, 1}, 1);
    EXPECT_THAT(onlyPrimitive(file).indices, ElementsAre(2, 0, 1));
}

TYPED_TEST(IndexType, OutOfRange_IsRefused) {
    SceneFile file;
    file.primitive()["indices"] = file.addAccessor<TypeParam>({2, 3, 1}, 1);
    EXPECT_THAT(failure(file.load()),
                HasSubstr("mesh 0 primitive 0 index 1 is 3; expected below 3"));
}

template <class T>
class ComponentType : public testing::Test {};
using ComponentTypes = testing::Types<int8_t, uint8_t, int16_t, uint16_t>;
TYPED_TEST_SUITE(ComponentType, ComponentTypes);

TYPED_TEST(ComponentType, NormalizedTexcoord_IsDividedByTheLargest) {
    constexpr TypeParam kMax = std::numeric_limits<TypeParam>::max();
    constexpr TypeParam kMin = std::numeric_limits<TypeParam>::min();
    SceneFile file;
    addNormals(file);
    file.attributes()["TEXCOORD_0"] =
        file.addAccessor<TypeParam>({0, kMax, kMin, kMax, kMax, 0}, 2, true);
    const scene::Primitive primitive = onlyPrimitive(file);
    ASSERT_EQ(primitive.uv0.size(), 3U);
    EXPECT_EQ(primitive.uv0[0], glm::vec2(0, 1));
    EXPECT_EQ(primitive.uv0[1], glm::vec2(std::is_signed_v<TypeParam> ? -1 : 0, 1));
}

TYPED_TEST(ComponentType, QuantizedPosition_KeepsItsValue) {
    SceneFile file;
    file.useExtension("KHR_mesh_quantization", true);
    addNormals(file);
    file.attributes()["POSITION"] = file.addAccessor<TypeParam>({0, 0, 0, 100, 0, 0, 0, 100, 7}, 3);
    EXPECT_EQ(onlyPrimitive(file).positions[2], glm::vec3(0, 100, 7));
}

TEST(Geometry, InterleavedViews_AreReadByStride) {
    SceneFile file;
    const std::vector<float> vertices{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 1};
    const int view = file.addView(bytesOf(vertices), 24);
    file.attributes()["POSITION"] = file.addAccessorOf(view, 5126, 3, 3);
    file.attributes()["NORMAL"] = file.addAccessorOf(view, 5126, 3, 3);
    file.json["accessors"][2]["byteOffset"] = 12;
    const scene::Primitive primitive = onlyPrimitive(file);
    EXPECT_EQ(primitive.positions[2], glm::vec3(0, 2, 0));
    EXPECT_EQ(primitive.normals[2], glm::vec3(0, 0, 1));
}

TEST(Geometry, SparseAccessor_ReplacesItsElements) {
    SceneFile file;
    addNormals(file);
    const int indices = file.addView(bytesOf<uint16_t>({0, 2}));
    const int values = file.addView(bytesOf<float>({5, 6, 7, 8, 9, 10}));
    file.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    EXPECT_THAT(onlyPrimitive(file).positions,
                ElementsAre(glm::vec3(5, 6, 7), glm::vec3(1, 0, 0), glm::vec3(8, 9, 10)));
}

TEST(Geometry, SparseAccessorOverAnInterleavedView_KeepsItsStride) {
    SceneFile file;
    const std::vector<float> vertices{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 1};
    const int view = file.addView(bytesOf(vertices), 24);
    const int position = file.addAccessorOf(view, 5126, 3, 3);
    file.attributes()["POSITION"] = position;
    addNormals(file);
    const int indices = file.addView(bytesOf<uint16_t>({1}));
    const int values = file.addView(bytesOf<float>({5, 6, 7}));
    file.json["accessors"][static_cast<size_t>(position)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    EXPECT_THAT(onlyPrimitive(file).positions,
                ElementsAre(glm::vec3(0), glm::vec3(5, 6, 7), glm::vec3(0, 2, 0)));
}

TEST(Geometry, SparseAccessorWithoutView_StartsFromZeros) {
    SceneFile file;
    addNormals(file);
    const int indices = file.addView(bytesOf<uint8_t>({1}));
    const int values = file.addView(bytesOf<float>({5, 6, 7}));
    file.attributes()["POSITION"] =
        file.add("accessors", {{"componentType", 5126},
                               {"count", 3},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 1},
                                 {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                 {"values", {{"bufferView", values}}}}}});
    EXPECT_THAT(onlyPrimitive(file).positions,
                ElementsAre(glm::vec3(0), glm::vec3(5, 6, 7), glm::vec3(0)));
}

TEST(Geometry, SparseIndices_WithoutViewAreRead) {
    SceneFile file;
    addNormals(file);
    const int indices = file.addView(bytesOf<uint8_t>({1, 2}));
    const int values = file.addView(bytesOf<uint16_t>({1, 2}));
    file.primitive()["indices"] =
        file.add("accessors", {{"componentType", 5123},
                               {"count", 3},
                               {"type", "SCALAR"},
                               {"sparse",
                                {{"count", 2},
                                 {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                 {"values", {{"bufferView", values}}}}}});
    EXPECT_THAT(onlyPrimitive(file).indices, ElementsAre(0, 1, 2));
}

TEST(Geometry, Strip_BecomesAListOfOneWinding) {
    SceneFile file = square();
    file.primitive()["mode"] = 5;
    EXPECT_THAT(onlyPrimitive(file).indices, ElementsAre(0, 1, 2, 1, 3, 2));
}

TEST(Geometry, IndexedFan_BecomesAList) {
    SceneFile file = square();
    file.primitive()["mode"] = 6;
    file.primitive()["indices"] = file.addAccessor<uint8_t>({0, 1, 3, 2}, 1);
    EXPECT_THAT(onlyPrimitive(file).indices, ElementsAre(1, 3, 0, 3, 2, 0));
}

TEST(Geometry, PointsAndLines_AreLeftOutWithAWarning) {
    SceneFile file;
    file.json["meshes"][0]["primitives"].push_back(file.primitive());
    file.json["meshes"][0]["primitives"][1]["mode"] = 1;
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1U);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("1 primitive is points or lines")));
}

TEST(Geometry, MeshOfPointsAlone_IsNotPlaced) {
    SceneFile file;
    file.primitive()["mode"] = 0;
    const scene::Scene scene = loaded(file.load());
    EXPECT_TRUE(scene.meshes.empty());
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.bounds_world.empty());
}

TEST(Geometry, IncompleteTriangle_IsIgnoredWithAWarning) {
    SceneFile file = square();
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.meshes.at(0).primitives.at(0).indices, ElementsAre(0, 1, 2));
    EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr("not a multiple of 3")));
}

TEST(Geometry, MissingNormals_AreFlatAndUnshared) {
    SceneFile file;
    file.attributes()["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 1, 1}, 2);
    file.attributes()["TANGENT"] =
        file.addAccessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    file.primitive()["indices"] = file.addAccessor<uint8_t>({0, 1, 2, 0, 2, 3}, 1);
    const scene::Primitive primitive = onlyPrimitive(file);
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_EQ(primitive.positions.size(), 6U);
    EXPECT_EQ(primitive.uv0[5], glm::vec2(1, 1));
    EXPECT_EQ(primitive.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.normals[3], glm::vec3(1, 0, 0));
    EXPECT_TRUE(primitive.tangents.empty()) << "the specification ignores them without normals";
}

TEST(Geometry, Tangents_KeepTheirHandedness) {
    SceneFile file;
    addNormals(file);
    file.attributes()["TANGENT"] =
        file.addAccessor<float>({3, 0, 0, -1, 3, 0, 0, 1, 3, 0, 0, 1}, 4);
    const scene::Primitive primitive = onlyPrimitive(file);
    ASSERT_EQ(primitive.tangents.size(), 3U);
    EXPECT_EQ(primitive.tangents[0], glm::vec4(1, 0, 0, -1));
}

TEST(Geometry, BrokenNormalsAndTangents_AreReplacedWithAWarning) {
    SceneFile file;
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 1}, 3);
    file.attributes()["TANGENT"] = file.addAccessor<float>(std::vector<float>(12, 0), 4);
    const scene::Scene scene = loaded(file.load());
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(primitive.normals[1], glm::vec3(0, 0, 1)) << "the triangle's";
    EXPECT_TRUE(primitive.tangents.empty());
    EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST(Geometry, SecondTexcoord_IsRead) {
    SceneFile file;
    addNormals(file);
    file.attributes()["TEXCOORD_1"] = file.addAccessor<float>({0, 0, 1, 0, 0, 0.25F}, 2);
    const scene::Primitive primitive = onlyPrimitive(file);
    EXPECT_TRUE(primitive.uv0.empty());
    EXPECT_EQ(primitive.uv1.at(2), glm::vec2(0, 0.25));
}

TEST(Geometry, ColorRgbFloat_GetsAlphaOne) {
    SceneFile file;
    addNormals(file);
    file.attributes()["COLOR_0"] = file.addAccessor<float>({0.5F, 2, -1, 0, 0, 0, 1, 1, 1}, 3);
    EXPECT_EQ(onlyPrimitive(file).colors.at(0), glm::vec4(0.5, 1, 0, 1)) << "clamped to 0..1";
}

TEST(Geometry, ColorRgbaBytes_AreNormalized) {
    SceneFile file;
    addNormals(file);
    file.attributes()["COLOR_0"] =
        file.addAccessor<uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0}, 4, true);
    const glm::vec4 color = onlyPrimitive(file).colors.at(0);
    EXPECT_FLOAT_EQ(color.x, 1);
    EXPECT_FLOAT_EQ(color.z, 0.2F);
    EXPECT_FLOAT_EQ(color.w, 0.4F);
}

TEST(Geometry, ColorRgbShorts_AreNormalized) {
    SceneFile file;
    addNormals(file);
    file.attributes()["COLOR_0"] =
        file.addAccessor<uint16_t>({65535, 0, 13107, 0, 0, 0, 0, 0, 0}, 3, true);
    const glm::vec4 color = onlyPrimitive(file).colors.at(0);
    EXPECT_FLOAT_EQ(color.x, 1);
    EXPECT_FLOAT_EQ(color.z, 0.2F);
}

TEST(Geometry, MorphTargets_ApplyTheMeshsDefaultWeights) {
    SceneFile file;
    addNormals(file);
    const int offsets = file.addAccessor<float>({0, 0, 4, 0, 0, 0, 0, 0, 0}, 3);
    file.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
    file.json["meshes"][0]["weights"] = {0.5};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).positions[0], glm::vec3(0, 0, 2));
    EXPECT_TRUE(scene.warnings.empty());
}

// Each may be missing, and what is broken is as good as missing.
TEST(Geometry, StreamsThatCannotBeRead_AreLeftOutWithAWarning) {
    for (const char* semantic : {"NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"}) {
        SCOPED_TRACE(semantic);
        SceneFile file;
        addNormals(file); // tangents need them
        file.attributes()[semantic] = file.addAccessor<float>({0, 1}, 2);
        const scene::Scene short_one = loaded(file.load());
        file.attributes()[semantic] = 99;
        const scene::Scene unknown = loaded(file.load());
        for (const auto* scene : {&short_one, &unknown}) {
            const scene::Primitive& primitive = scene->meshes.at(0).primitives.at(0);
            EXPECT_EQ(primitive.positions.size(), 3U);
            EXPECT_EQ(primitive.normals.size(), 3U) << "the triangle's, where there are none";
            EXPECT_TRUE(primitive.tangents.empty() && primitive.uv0.empty() &&
                        primitive.uv1.empty() && primitive.colors.empty());
        }
        ASSERT_FALSE(unknown.warnings.empty());
        EXPECT_EQ(unknown.warnings[0].code, "VERTEX_STREAM_NOT_READ");
        EXPECT_EQ(unknown.warnings[0].pointer,
                  "/meshes/0/primitives/0/attributes/" + std::string(semantic));
        EXPECT_THAT(unknown.warnings[0].message, HasSubstr("accessor 99"));
    }
}

TEST(Geometry, UnequalCounts_AreNamed) {
    SceneFile file;
    addNormals(file, 2);
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(
        scene.warnings[0].message,
        "mesh 0 primitive 0 NORMAL has 2 elements; expected 3, as POSITION has; it is left out");
}

TEST(Geometry, WrongType_IsRefused) {
    SceneFile file;
    file.attributes()["POSITION"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    EXPECT_THAT(failure(file.load()), HasSubstr("with 2 components; expected 3"));
}

} // namespace
} // namespace froxel::gltf
