#include "files.h"

#include <cstring>
#include <gmock/gmock.h>

namespace froxel::formats {
namespace {

using testing::HasSubstr;

constexpr const char* kTriangle = "solid a solid\n"
                                  " FACET normal 0 0 1\n  outer loop\n"
                                  "   vertex 0 0 0\n   vertex 1e1 0 0\n   vertex 0 10 5\n"
                                  "  endloop\n endfacet\nendsolid a\n";

std::string binary(uint32_t triangles, const char* header = "x") {
    std::string file(80, '\0');
    file.replace(0, std::strlen(header), header);
    file.append(reinterpret_cast<const char*>(&triangles), sizeof triangles);
    for (uint32_t i = 0; i < triangles; ++i) {
        const float numbers[12] = {0, 0, 0, 0, 0, 0, 10, 0, 0, 0, 10, static_cast<float>(5 + i)};
        file.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
    }
    return file;
}

void expectTriangle(const Result<scene::Scene>& scene) {
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->meshes.size(), 1U);
    EXPECT_EQ(scene->meshes[0].primitives[0].indices.size(), 3U);
    // 10 mm wide and deep, 5 mm high: z is up, and y of glTF.
    const glm::dvec3 size = scene->bounds_world.max - scene->bounds_world.min;
    EXPECT_NEAR(size.x, 0.01, 1e-9);
    EXPECT_NEAR(size.y, 0.005, 1e-9);
    EXPECT_NEAR(size.z, 0.01, 1e-9);
    EXPECT_TRUE(warns(*scene, "millimetres, with z up"));
}

TEST(Stl, TextAndBinaryAreTheSame) {
    Files files;
    files.add("text.stl", kTriangle).add("binary.STL", binary(1));
    expectTriangle(files.load("text.stl"));
    expectTriangle(files.load("binary.STL"));
}

TEST(Stl, BinaryThatBeginsLikeText_IsBinary) {
    Files files;
    files.add("a.stl", binary(1, "solid of a binary exporter"));
    expectTriangle(files.load("a.stl"));
}

TEST(Stl, SeveralSolidsAreOneScene) {
    Files files;
    files.add("a.stl", std::string(kTriangle) + kTriangle);
    EXPECT_EQ(files.load("a.stl").value().meshes[0].primitives[0].indices.size(), 6U);
}

TEST(Stl, WhatIsCutShortIsRefusedAtEveryByte) {
    const std::string text = kTriangle;
    const size_t facet_end = text.find("endfacet") + std::strlen("endfacet");
    for (size_t size = 0; size < facet_end; ++size) {
        EXPECT_NE(Files().add("a.stl", text.substr(0, size)).faultOf("a.stl"), "") << size;
    }
    const std::string bytes = binary(2);
    for (size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(Files().add("a.stl", bytes.substr(0, size)).faultOf("a.stl"), "") << size;
    }
}

TEST(Stl, RefusalsNamePlaceAndNumbers) {
    Files files;
    files.add("text.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n");
    EXPECT_THAT(files.faultOf("text.stl"), HasSubstr("line 2 is not the facet"));
    files.add("binary.stl", binary(3).substr(0, 150));
    EXPECT_THAT(files.faultOf("binary.stl"),
                HasSubstr("it has 150 bytes, and 3 triangles take 234"));
    files.add("none.stl", binary(0));
    EXPECT_THAT(files.faultOf("none.stl"), HasSubstr("it has no triangles"));
}

} // namespace
} // namespace froxel::formats
