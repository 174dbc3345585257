// EXT_meshopt_compression and KHR_draco_mesh_compression.
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

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

const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::vector<float> kNormals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

Bytes encodeVertices(const void* vertices, size_t count, size_t stride) {
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), vertices, count, stride));
    return bytes;
}

Bytes encodeTriangles(const std::vector<unsigned>& indices, size_t vertex_count) {
    Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                           bytes.size(), indices.data(), indices.size()));
    return bytes;
}

Bytes encodeSequence(const std::vector<unsigned>& indices, size_t vertex_count) {
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()),
                                             bytes.size(), indices.data(), indices.size()));
    return bytes;
}

// A view of the fallback buffer (which has no data) that is really `encoded` in buffer 0.
int addCompressed(SceneFile& file,
                  const Bytes& encoded,
                  size_t count,
                  size_t stride,
                  const char* mode,
                  const char* filter = "NONE") {
    const int stored = file.addView(encoded);
    Json extension = file.json["bufferViews"][static_cast<size_t>(stored)];
    extension.update(
        {{"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}});
    file.json["buffers"][1] = {{"byteLength", 1 << 20},
                               {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
    return file.add("bufferViews",
                    {{"buffer", 1},
                     {"byteLength", count * stride},
                     {"extensions", {{"EXT_meshopt_compression", std::move(extension)}}}});
}

SceneFile meshoptSquare() {
    SceneFile file;
    file.useExtension("EXT_meshopt_compression", true);
    const int positions =
        addCompressed(file, encodeVertices(kCorners.data(), 4, 12), 4, 12, "ATTRIBUTES");
    const int indices =
        addCompressed(file, encodeTriangles({0, 1, 2, 2, 1, 3}, 4), 6, 2, "TRIANGLES");
    file.attributes()["POSITION"] = file.addAccessorOf(positions, 5126, 4, 3);
    file.attributes()["NORMAL"] = file.addAccessor<float>(kNormals, 3);
    file.primitive()["indices"] = file.addAccessorOf(indices, 5123, 6, 1);
    return file;
}

Json& extensionOf(SceneFile& file, size_t view) {
    return file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

// Of four corners. From 0.22 on the encoder takes a mode, too, whose first is the plain one.
template <class... Mode>
void encodeExponents(void (*encode)(void*, size_t, size_t, int, const float*, Mode...),
                     uint32_t* filtered,
                     const float* corners) {
    encode(filtered, 4, 12, 20, corners, Mode{}...);
}

TEST(Meshopt, AttributesAndTriangles_AreDecoded) {
    const scene::Scene scene = loaded(meshoptSquare().load());
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    ASSERT_EQ(primitive.positions.size(), 4U);
    EXPECT_EQ(primitive.positions[3], glm::vec3(1, 1, 0));
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2, 2, 1, 3));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Meshopt, Glb_UsesTheFallbackWithoutData) {
    EXPECT_EQ(loaded(meshoptSquare().loadGlb()).instances.size(), 1U);
}

TEST(Meshopt, IndexSequence_IsDecoded) {
    SceneFile file = meshoptSquare();
    const int indices = addCompressed(file, encodeSequence({3, 1, 2, 0, 1, 2}, 4), 6, 4, "INDICES");
    file.primitive()["indices"] = file.addAccessorOf(indices, 5125, 6, 1);
    EXPECT_THAT(loaded(file.load()).meshes.at(0).primitives.at(0).indices,
                ElementsAre(3, 1, 2, 0, 1, 2));
}

TEST(Meshopt, OctahedralFilter_GivesNormals) {
    SceneFile file = meshoptSquare();
    const std::vector<float> normals{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0.6F, 0, 0.8F, 0};
    std::vector<int8_t> filtered(16);
    meshopt_encodeFilterOct(filtered.data(), 4, 4, 8, normals.data());
    const int view = addCompressed(file, encodeVertices(filtered.data(), 4, 4), 4, 4, "ATTRIBUTES",
                                   "OCTAHEDRAL");
    file.attributes()["NORMAL"] = file.addAccessorOf(view, 5120, 4, 3, true);
    file.json["bufferViews"][static_cast<size_t>(view)]["byteStride"] = 4;
    const scene::Scene scene = loaded(file.load());
    const auto& read = scene.meshes.at(0).primitives.at(0).normals;
    EXPECT_LT(glm::length(read.at(1) - glm::vec3(0, 1, 0)), 0.02F);
    EXPECT_LT(glm::length(read.at(3) - glm::vec3(0.6F, 0, 0.8F)), 0.02F);
}

TEST(Meshopt, ExponentialFilter_GivesFloats) {
    SceneFile file = meshoptSquare();
    std::vector<uint32_t> filtered(12);
    encodeExponents(meshopt_encodeFilterExp, filtered.data(), kCorners.data());
    const int view = addCompressed(file, encodeVertices(filtered.data(), 4, 12), 4, 12,
                                   "ATTRIBUTES", "EXPONENTIAL");
    file.attributes()["POSITION"] = file.addAccessorOf(view, 5126, 4, 3);
    const scene::Scene scene = loaded(file.load());
    const glm::vec3 corner = scene.meshes.at(0).primitives.at(0).positions.at(3);
    EXPECT_LT(glm::length(corner - glm::vec3(1, 1, 0)), 1e-4F);
}

TEST(Meshopt, QuaternionFilter_GivesRotations) {
    SceneFile file = meshoptSquare();
    const std::vector<float> turns{0, 0, 0, 1, 0, 0, 1, 0};
    std::vector<int16_t> filtered(8);
    meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
    const int view = addCompressed(file, encodeVertices(filtered.data(), 2, 8), 2, 8, "ATTRIBUTES",
                                   "QUATERNION");
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"ROTATION", file.addAccessorOf(view, 5122, 2, 4, true)}};
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_NEAR(scene.instances[0].world_from_object[0].x, 1, 1e-4);
    EXPECT_NEAR(scene.instances[1].world_from_object[0].x, -1, 1e-4);
}

TEST(Meshopt, BrokenStream_IsRefused) {
    SceneFile file = meshoptSquare();
    extensionOf(file, 2)["byteLength"] = 10;
    EXPECT_THAT(failure(file.load()), HasSubstr("bufferView 2 has 10 bytes of meshopt data"));
}

TEST(Meshopt, IndicesOutOfRange_AreRefused) {
    SceneFile file = meshoptSquare();
    const int indices =
        addCompressed(file, encodeTriangles({0, 1, 2, 2, 1, 7}, 8), 6, 2, "TRIANGLES");
    file.primitive()["indices"] = file.addAccessorOf(indices, 5123, 6, 1);
    EXPECT_THAT(failure(file.load()), HasSubstr("is 7; expected below 4"));
}

TEST(Meshopt, BadParameters_AreRefused) {
    const auto refused = [](const char* key, const Json& value) {
        SceneFile file = meshoptSquare();
        extensionOf(file, 2)[key] = value;
        return failure(file.load());
    };
    EXPECT_THAT(refused("mode", "POINTS"), HasSubstr("bufferView 2"));
    EXPECT_THAT(refused("filter", "BLUR"), HasSubstr("filter 'BLUR'"));
    EXPECT_THAT(refused("filter", "OCTAHEDRAL"), HasSubstr("byteStride 12"));
    EXPECT_THAT(refused("byteStride", 3), HasSubstr("byteStride 3"));
    EXPECT_THAT(refused("byteStride", 1024), HasSubstr("byteStride 1024"));
    EXPECT_THAT(refused("count", 2'000'000'000), HasSubstr("of meshopt data hold 24000000000"));
    EXPECT_THAT(refused("byteLength", 2'000'000'000), HasSubstr("bufferView 2 ends at byte"));
    EXPECT_THAT(refused("buffer", 9), HasSubstr("bufferView 2 uses buffer 9"));
}

struct DracoStream {
    Bytes bytes;
    size_t vertex_count = 0;
    int position_id = 0;
    int normal_id = 0;
    int color_id = 0;
};

// The square as two triangles, with normals and normalised colours.
DracoStream dracoSquare(int method) {
    const auto corner = [](size_t i) { return kCorners.data() + 3 * i; };
    const auto normal = [](size_t i) { return kNormals.data() + 3 * i; };
    const std::array<uint8_t, 4> color{255, 0, 51, 255};
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normals =
        builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    const std::array<std::array<size_t, 3>, 2> faces{{{0, 1, 2}, {2, 1, 3}}};
    for (uint32_t i = 0; i < 2; ++i) {
        const auto& [a, b, c] = faces[i];
        const draco::FaceIndex face(i);
        builder.SetAttributeValuesForFace(position, face, corner(a), corner(b), corner(c));
        builder.SetAttributeValuesForFace(normals, face, normal(a), normal(b), normal(c));
        builder.SetAttributeValuesForFace(colors, face, color.data(), color.data(), color.data());
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const auto* first = reinterpret_cast<const std::byte*>(buffer.data());
    const auto id = [&](int attribute) {
        return static_cast<int>(mesh->attribute(attribute)->unique_id());
    };
    return {Bytes(first, first + buffer.size()), mesh->num_points(), id(position), id(normals),
            id(colors)};
}

SceneFile dracoFile(const DracoStream& stream) {
    SceneFile file;
    file.useExtension("KHR_draco_mesh_compression", true);
    const size_t count = stream.vertex_count;
    file.attributes() = {{"POSITION", file.addAccessorOf(-1, 5126, count, 3)},
                         {"NORMAL", file.addAccessorOf(-1, 5126, count, 3)},
                         {"COLOR_0", file.addAccessorOf(-1, 5121, count, 4, true)}};
    file.primitive()["indices"] = file.addAccessorOf(-1, 5125, 6, 1);
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", file.addView(stream.bytes)},
        {"attributes",
         {{"POSITION", stream.position_id},
          {"NORMAL", stream.normal_id},
          {"COLOR_0", stream.color_id}}}};
    return file;
}

class Draco : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Methods,
                         Draco,
                         testing::Values(draco::MESH_SEQUENTIAL_ENCODING,
                                         draco::MESH_EDGEBREAKER_ENCODING));

TEST_P(Draco, Stream_GivesTheSquare) {
    const scene::Scene scene = loaded(dracoFile(dracoSquare(GetParam())).load());
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(primitive.indices.size(), 6U);
    ASSERT_EQ(primitive.positions.size(), 4U);
    EXPECT_EQ(primitive.bounds.max, glm::vec3(1, 1, 0));
    EXPECT_LT(glm::length(primitive.normals.at(0) - glm::vec3(0, 0, 1)), 0.01F);
    EXPECT_FLOAT_EQ(primitive.colors.at(0).z, 0.2F);
    double area = 0;
    for (size_t i = 0; i < 6; i += 3) {
        const glm::vec3 a = primitive.positions[primitive.indices[i]];
        const glm::vec3 b = primitive.positions[primitive.indices[i + 1]];
        const glm::vec3 c = primitive.positions[primitive.indices[i + 2]];
        area += 0.5 * static_cast<double>(glm::cross(b - a, c - a).z);
    }
    EXPECT_NEAR(area, 1, 1e-5) << "both triangles wound towards +Z";
}

TEST_P(Draco, TruncatedStream_IsRefused) {
    DracoStream stream = dracoSquare(GetParam());
    for (const size_t size : {size_t{4}, size_t{11}, stream.bytes.size() / 2}) {
        DracoStream shorter = stream;
        shorter.bytes.resize(size);
        EXPECT_THAT(failure(dracoFile(shorter).load()), HasSubstr("mesh 0 primitive 0"));
    }
}

// "Must use the decompressed data": Blender's exporters up to 1.2.75 write others.
TEST_P(Draco, CountsUnlikeTheAccessors_TheStreamWins_WithAWarning) {
    DracoStream stream = dracoSquare(GetParam());
    const auto expectSquare = [](const SceneFile& file) {
        const scene::Scene scene = loaded(file.load());
        EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 6U);
        EXPECT_EQ(scene.meshes.at(0).primitives.at(0).positions.size(), 4U);
        EXPECT_EQ(scene.meshes.at(0).primitives.at(0).colors.size(), 4U);
        ASSERT_EQ(scene.warnings.size(), 1U);
        EXPECT_THAT(scene.warnings[0].message,
                    HasSubstr("but 4 and 6 in its Draco stream, which is drawn"));
    };
    SceneFile file = dracoFile(stream);
    file.json["accessors"][4]["count"] = 9;
    expectSquare(file);
    for (const size_t count : {3U, 5U, 1000U}) {
        stream.vertex_count = count;
        expectSquare(dracoFile(stream));
    }
}

TEST_P(Draco, AttributeBesideTheStream_OfTheAccessorsCount_IsLeftOut) {
    DracoStream stream = dracoSquare(GetParam());
    stream.vertex_count = 3;
    SceneFile file = dracoFile(stream);
    file.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"].erase("NORMAL");
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_THAT(scene.warnings[1].message + scene.warnings[0].message,
                HasSubstr("NORMAL has 3 elements; expected 4"));
}

// Whatever a byte becomes: a scene with indices in range, or one line.
TEST_P(Draco, AnyDamagedByte_GivesASceneOrOneLine) {
    const DracoStream whole = dracoSquare(GetParam());
    size_t refused_count = 0;
    for (size_t i = 0; i < whole.bytes.size(); ++i) {
        for (const unsigned bits : {0x01U, 0x7FU, 0x80U, 0xFFU}) {
            DracoStream damaged = whole;
            damaged.bytes[i] ^= static_cast<std::byte>(bits);
            const Result<scene::Scene> result = dracoFile(damaged).load();
            refused_count += result.has_value() ? 0U : 1U;
            if (result.has_value()) {
                const scene::Primitive& primitive = result->meshes.at(0).primitives.at(0);
                EXPECT_LT(*std::max_element(primitive.indices.begin(), primitive.indices.end()),
                          primitive.positions.size());
            } else {
                (void)failure(result);
            }
        }
    }
    EXPECT_GT(refused_count, 0U);
}

TEST_P(Draco, UnknownAttribute_IsLeftOut) {
    DracoStream stream = dracoSquare(GetParam());
    stream.normal_id = 77;
    const scene::Scene scene = loaded(dracoFile(stream).load());
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_THAT(scene.warnings[0].message, HasSubstr("NORMAL uses the Draco attribute 77"));
}

} // namespace
} // namespace froxel::gltf
