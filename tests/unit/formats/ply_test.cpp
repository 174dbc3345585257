#include "files.h"

#include <algorithm>
#include <array>
#include <gmock/gmock.h>

namespace froxel::formats {
namespace {

using testing::HasSubstr;

std::string headed(const std::string& rest, const std::string& format = "ascii") {
    return "ply\nformat " + format + " 1.0\ncomment of a test\n" + rest;
}

constexpr const char* kSquare = "element vertex 4\nproperty float x\nproperty float y\n"
                                "property float z\nelement face 1\n"
                                "property list uchar int vertex_indices\nend_header\n"
                                "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

template <class T>
void add(std::string& bytes, T value, bool big) {
    auto* const begin = reinterpret_cast<char*>(&value);
    if (big) {
        std::reverse(begin, begin + sizeof value);
    }
    bytes.append(begin, sizeof value);
}

TEST(Ply, PolygonIsAFan_WithSmoothNormals) {
    const auto scene = Files().add("a.ply", headed(kSquare)).load("a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    const scene::Primitive& square = scene->meshes[0].primitives[0];
    EXPECT_EQ(square.positions.size(), 4U);
    EXPECT_EQ(square.indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(square.normals[0], glm::vec3(0, 0, 1));
    EXPECT_TRUE(warns(*scene, "metres, with y up"));
}

TEST(Ply, BinaryOfEitherByteOrder) {
    for (const bool big : {false, true}) {
        std::string file = headed("element vertex 3\nproperty double x\nproperty double y\n"
                                  "property int z\nproperty ushort red\nproperty ushort green\n"
                                  "property ushort blue\nelement other 1\nproperty uchar a\n"
                                  "element face 1\nproperty list uint ushort vertex_index\n"
                                  "end_header\n",
                                  big ? "binary_big_endian" : "binary_little_endian");
        for (int i = 0; i < 3; ++i) {
            add(file, i == 1 ? 2.0 : 0.0, big);
            add(file, i == 2 ? 4.0 : 0.0, big);
            add(file, int32_t{-3}, big);
            add(file, uint16_t{65535}, big);
            add(file, uint16_t{0}, big);
            add(file, uint16_t{0}, big);
        }
        add(file, uint8_t{7}, big);
        add(file, uint32_t{3}, big);
        for (const auto index : std::to_array<uint16_t>({0, 1, 2})) {
            add(file, index, big);
        }
        const auto scene = Files().add("a.ply", file).load("a.ply");
        ASSERT_TRUE(scene) << scene.error().message;
        const scene::Primitive& part = scene->meshes[0].primitives[0];
        EXPECT_EQ(part.positions[1], glm::vec3(2, 0, -3));
        EXPECT_EQ(part.positions[2], glm::vec3(0, 4, -3));
        EXPECT_EQ(part.colors[0], glm::vec4(1, 0, 0, 1));
        for (size_t size = 0; size < file.size(); ++size) {
            EXPECT_NE(Files().add("a.ply", file.substr(0, size)).faultOf("a.ply"), "") << size;
        }
    }
}

TEST(Ply, ColoursAreSrgb_AndNormalsTheFiles) {
    const auto scene =
        Files()
            .add("a.ply", headed("element vertex 3\nproperty float x\nproperty float y\n"
                                 "property float z\nproperty float nx\nproperty float ny\n"
                                 "property float nz\nproperty uchar red\nproperty uchar green\n"
                                 "property uchar blue\nelement face 1\n"
                                 "property list uchar int vertex_indices\nend_header\n"
                                 "0 0 0 0 1 0 188 0 255\n1 0 0 0 1 0 188 0 255\n"
                                 "0 0 1 0 1 0 188 0 255\n3 0 1 2\n"))
            .load("a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    const scene::Primitive& part = scene->meshes[0].primitives[0];
    EXPECT_EQ(part.normals[0], glm::vec3(0, 1, 0));
    EXPECT_NEAR(part.colors[0].x, 0.5, 0.005); // 188 of sRGB is half of the light
    EXPECT_EQ(part.colors[0].z, 1);
    EXPECT_EQ(scene->materials[part.material].base_color, glm::vec4(1));
}

TEST(Ply, TextureCoordinatesOfCorners) {
    Files files;
    files.add("a.ply", headed("comment TextureFile C:\\scans\\my scan.png\nelement vertex 3\n"
                              "property float x\nproperty float y\nproperty float z\n"
                              "element face 1\nproperty list uchar int vertex_indices\n"
                              "property list uchar float texcoord\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 0.25\n"));
    const auto scene = files.load("a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].primitives[0].uv0[2], glm::vec2(0, 0.75F));
    EXPECT_TRUE(warns(*scene, "my scan.png"));
}

TEST(Ply, RefusalsNameWhatIsWrong) {
    const auto faultOf = [](const std::string& text) {
        return Files().add("a.ply", text).faultOf("a.ply");
    };
    const std::string square = kSquare;
    EXPECT_THAT(faultOf("plywood\n"), HasSubstr("it begins with 'plywood'"));
    EXPECT_THAT(faultOf(headed("element vertex 4\n")), HasSubstr("no end_header"));
    EXPECT_THAT(faultOf(headed("element vertex 4\nproperty half x\nend_header\n")),
                HasSubstr("has type 'half'"));
    EXPECT_THAT(faultOf(headed(kSquare, "ebcdic")), HasSubstr("its format is 'ebcdic'"));
    EXPECT_THAT(faultOf(headed("element vertex 99999999999\nproperty float x\nend_header\n1\n")),
                HasSubstr("it has 99999999999 of 'vertex' in 2 bytes"));
    EXPECT_THAT(faultOf(headed(square.substr(0, square.size() - 10) + "4 0 1 2 4\n")),
                HasSubstr("face 0 has vertex 4; the file has 4"));
    EXPECT_THAT(faultOf(headed(square.substr(0, square.size() - 10) + "4000 0 1\n")),
                HasSubstr("a list of 4000 numbers in"));
    EXPECT_THAT(faultOf(headed(square.substr(0, square.size() - 10) + "-1\n")),
                HasSubstr("a list of -1 numbers in"));
    EXPECT_THAT(faultOf(headed("element vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n1 2 3\n")),
                HasSubstr("1 vertices and no faces; points are not drawn"));
}

} // namespace
} // namespace froxel::formats
