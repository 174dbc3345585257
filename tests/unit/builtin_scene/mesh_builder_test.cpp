#include "builtin_scene/mesh_builder.h"
#include "builtin_scene/noise.h"
#include "builtin_scene/profile.h"
#include "builtin_scene/texture.h"
#include "builtin_scene/wall.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::builtin_scene {
namespace {

double signedVolume(const scene::Mesh& mesh) {
    double sum = 0;
    for (const scene::Primitive& p : mesh.primitives) {
        for (size_t i = 0; i < p.indices.size(); i += 3) {
            const glm::dvec3 a(p.positions[p.indices[i]]);
            const glm::dvec3 b(p.positions[p.indices[i + 1]]);
            const glm::dvec3 c(p.positions[p.indices[i + 2]]);
            sum += glm::dot(a, glm::cross(b, c)) / 6.0;
        }
    }
    return sum;
}

double areaOf(const scene::Mesh& mesh) {
    double sum = 0;
    for (const scene::Primitive& p : mesh.primitives) {
        for (size_t i = 0; i < p.indices.size(); i += 3) {
            const glm::vec3 a = p.positions[p.indices[i]];
            sum += 0.5 * glm::length(glm::cross(p.positions[p.indices[i + 1]] - a,
                                                p.positions[p.indices[i + 2]] - a));
        }
    }
    return sum;
}

TEST(MeshBuilder, BevelledBox_EnclosesItsVolumeWithoutTheChamfers) {
    MeshBuilder builder(Surface::kLimestone);
    builder.box({0, 0, 0}, {1, 2, 3}, 0.1F);
    // Twelve edges lose a prism of 0.1 x 0.1 / 2 and corners a little of it twice.
    EXPECT_NEAR(signedVolume(builder.build("box")),
                6.0 - 0.005 * 4 * (0.8 + 1.8 + 2.8) - 8 * 0.000833, 2e-3);
}

TEST(MeshBuilder, MirroredAppend_FacesStillLookOutward) {
    MeshBuilder part(Surface::kLimestone);
    part.box({0, 0, 0}, {1, 1, 1}, 0.05F);
    MeshBuilder whole(Surface::kLimestone);
    glm::mat4 mirror(1.0F);
    mirror[0].x = -1.0F;
    whole.append(part, mirror);
    EXPECT_NEAR(signedVolume(whole.build("mirrored")), signedVolume(part.build("part")), 1e-6);
}

TEST(MeshBuilder, Warp_TurnsNormalsWithTheSurface) {
    MeshBuilder builder(Surface::kLimestone);
    builder.polygon({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
    builder.warp([](glm::vec3 p) { return glm::vec3(p.x, p.y + 0.5F * p.x, p.z); });
    const glm::vec3 expected = glm::normalize(glm::vec3(-0.5F, 1.0F, 0.0F));
    const scene::Mesh mesh = builder.build("slope");
    for (const glm::vec3& normal : mesh.primitives.at(0).normals) {
        EXPECT_NEAR(glm::length(normal - expected), 0.0F, 1e-4F);
    }
}

TEST(Profile, ClosedLathe_HasTheVolumeOfItsSolid) {
    MeshBuilder builder(Surface::kLimestone);
    addLathe(builder, Profile({0, 0}).to({1, 0}).to({1, 2}).to({0, 2}), 256);
    EXPECT_NEAR(signedVolume(builder.build("cylinder")), 2.0 * glm::pi<double>(), 2e-3);
}

TEST(Profile, ClosedTube_HasTheVolumeOfATorus) {
    MeshBuilder builder(Surface::kGold);
    addTube(builder, 128, 64, 0.2F, true, [](float t) {
        const float angle = glm::two_pi<float>() * t;
        return glm::vec3(std::cos(angle), 0, std::sin(angle));
    });
    const double torus = 2.0 * glm::pi<double>() * glm::pi<double>() * 0.04;
    EXPECT_NEAR(signedVolume(builder.build("torus")), torus, 0.01 * torus);
}

TEST(Wall, WithAnArchAndARose_HasTheAreaThatIsLeft) {
    MeshBuilder builder(Surface::kAshlar);
    addWall(
        builder, -4, 4, [](float) { return 0.0F; }, [](float) { return 10.0F; },
        {archOpening(0, 1.5F, 0, 3, 256, true), roundOpening(0, 7, 1, 256)});
    const double pi = glm::pi<double>();
    EXPECT_NEAR(areaOf(builder.build("wall")), 80.0 - (9.0 + 0.5 * pi * 2.25) - pi, 2e-3);
}

TEST(Noise, AcrossItsPeriod_Repeats) {
    for (int i = 0; i < 50; ++i) {
        const glm::vec2 p(0.37F * static_cast<float>(i), 0.21F * static_cast<float>(i));
        EXPECT_NEAR(gradientNoise(p, 4, 7), gradientNoise(p + glm::vec2(4, -4), 4, 7), 1e-3F);
        EXPECT_NEAR(cellNoise(p, 4, 7).nearest, cellNoise(p + glm::vec2(-4, 4), 4, 7).nearest,
                    1e-3F);
    }
}

TEST(Texture, SlopeUpToTheRight_NormalLeansLeft) {
    const Recipe recipe{.name = "slope", .size_px = 16, .tile_m = 1.0F, .at = [](glm::vec2 uv) {
                            Texel texel;
                            texel.height_m = 0.5F * uv.x;
                            return texel;
                        }};
    const BakedMaps maps = bake(recipe);
    const size_t middle = (8 * 16 + 8) * 4;
    const glm::vec3 expected = glm::normalize(glm::vec3(-0.5F, 0.0F, 1.0F));
    EXPECT_NEAR(std::to_integer<int>(maps.normal.rgba8[middle]), (expected.x * 0.5F + 0.5F) * 255,
                1);
    EXPECT_NEAR(std::to_integer<int>(maps.normal.rgba8[middle + 1]), 127.5, 1);
    EXPECT_NEAR(std::to_integer<int>(maps.normal.rgba8[middle + 2]),
                (expected.z * 0.5F + 0.5F) * 255, 1);
}

} // namespace
} // namespace froxel::builtin_scene
