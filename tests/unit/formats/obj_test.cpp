#include "files.h"

#include <gmock/gmock.h>

namespace froxel::formats {
namespace {

using testing::HasSubstr;

constexpr const char* kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

TEST(Obj, ObjectsAreMeshes_AndMaterialsTheirParts) {
    Files files;
    files.add("a.mtl", "newmtl red\nKd 1 0 0\nNs 0\nillum 2\n"
                       "newmtl half\nKd 0 0 1\nd 0.5\nPr 0.25\nPm 1\nKe 0 1 0\n");
    files.add("a.obj", std::string("mtllib a.mtl\no box\n") + kCorners +
                           "usemtl red\nf 1 2 3 4\nusemtl half\nf 1 2 5\no other\nf -1 -2 -3\n");
    const auto scene = files.load("a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->instances.size(), 2U);
    EXPECT_EQ(scene->instances[0].name, "box");
    EXPECT_EQ(scene->instances[1].name, "other");
    ASSERT_EQ(scene->meshes[0].primitives.size(), 2U);
    EXPECT_EQ(scene->meshes[0].primitives[0].indices.size(), 6U);
    const scene::Material& red = scene->materials[scene->meshes[0].primitives[0].material];
    EXPECT_EQ(red.base_color, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(red.metallic, 0);
    EXPECT_EQ(red.roughness, 1); // of no shininess
    const scene::Material& half = scene->materials[scene->meshes[0].primitives[1].material];
    EXPECT_EQ(half.base_color.w, 0.5F);
    EXPECT_EQ(half.alpha_mode, scene::AlphaMode::kBlend);
    EXPECT_EQ(half.roughness, 0.25F);
    EXPECT_EQ(half.metallic, 1);
    EXPECT_EQ(half.emissive, glm::vec3(0, 1, 0));
    EXPECT_TRUE(warns(*scene, "metres, with y up"));
}

TEST(Obj, NormalsAreTheFiles_OrOfSmoothingGroups_OrFlat) {
    const auto normalOf = [](const std::string& faces, size_t vertex) {
        const auto scene = Files().add("a.obj", kCorners + faces).load("a.obj");
        return scene.value().meshes[0].primitives[0].normals[vertex];
    };
    EXPECT_EQ(normalOf("vn 0 1 0\nf 1//1 2//1 3//1\n", 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(normalOf("f 1 2 3\nf 1 5 2\n", 0), glm::vec3(0, 0, 1));
    EXPECT_EQ(normalOf("f 1 2 3\nf 1 5 2\n", 3), glm::vec3(0, 1, 0));
    const glm::vec3 smooth = normalOf("s 1\nf 1 2 3\nf 1 5 2\n", 0);
    EXPECT_NEAR(smooth.y, smooth.z, 1e-6);
    EXPECT_NEAR(smooth.y, 0.70710678, 1e-6);
}

TEST(Obj, TextureCoordinatesRunDownAsInGltf) {
    const auto scene =
        Files()
            .add("a.obj", std::string(kCorners) + "vt 0 0\nvt 1 0\nvt 1 0.75\nf 1/1 2/2 3/3\n")
            .load("a.obj");
    EXPECT_EQ(scene.value().meshes[0].primitives[0].uv0[2], glm::vec2(1, 0.25F));
}

TEST(Obj, ImagesThatAreMissingAreSaid_AndPathsOfOtherMachinesAreNames) {
    Files files;
    files.add("a.mtl", "newmtl wall\nmap_Kd C:\\textures\\wall 2.png\nmap_Bump bump.png\n");
    files.add("a.obj", std::string("mtllib a.mtl\n") + kCorners +
                           "vt 0 0\nusemtl wall\nf 1/1 2/1 3/1\nl 1 2\n");
    const auto scene = files.load("a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(warns(*scene, "'wall 2.png'"));
    EXPECT_TRUE(warns(*scene, "has map_Bump, which is not read"));
    EXPECT_TRUE(warns(*scene, "lines and points are not drawn"));
    EXPECT_EQ(scene->materials[0].base_color, glm::vec4(1));
}

TEST(Obj, MissingMaterialsAreAWarning_AndAreNotReadFromOutside) {
    Files files;
    files.add("a.obj", std::string("mtllib gone.mtl\n") + kCorners + "f 1 2 3\n");
    EXPECT_TRUE(warns(files.load("a.obj").value(), "'gone.mtl'"));
    files.add("b.obj", std::string("mtllib ../../etc/hostname\n") + kCorners + "f 1 2 3\n");
    EXPECT_TRUE(warns(files.load("b.obj").value(), "etc/hostname"));
}

TEST(Obj, ColoursOfVertices) {
    const auto scene = Files()
                           .add("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n")
                           .load("a.obj");
    const scene::Primitive& part = scene.value().meshes[0].primitives[0];
    EXPECT_EQ(part.colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(scene->materials[part.material].base_color, glm::vec4(1));
}

TEST(Obj, RefusalsNameWhatIsWrong) {
    const auto faultOf = [](const std::string& text) {
        return Files().add("a.obj", text).faultOf("a.obj");
    };
    EXPECT_THAT(faultOf(std::string(kCorners) + "f 1 2 9\n"),
                HasSubstr("face 0 uses vertex 9; the file has 5"));
    EXPECT_THAT(faultOf(std::string(kCorners) + "vn 0 1 0\nf 1//1 2//1 3//2\n"),
                HasSubstr("face 0 uses normal 2; the file has 1"));
    EXPECT_THAT(faultOf(kCorners), HasSubstr("it has no faces"));
    EXPECT_THAT(faultOf(""), HasSubstr("it has no faces"));
}

} // namespace
} // namespace froxel::formats
