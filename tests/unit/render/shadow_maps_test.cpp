// The mathematics of shadow maps: faces, their culling and the bias of lib/shadow.glsl.
#include "render/steps/shadow_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace froxel::render {

namespace {

using glm::dvec3;

class Random {
  public:
    double in(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(engine_);
    }
    dvec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(dvec3(normal(engine_), normal(engine_), normal(engine_)));
    }

  private:
    std::mt19937 engine_{17};
};

double scaleOf(uint32_t size_px) {
    return (size_px - 2.0 * io::kShadowBorder) / size_px;
}

// The face that a point lies on.
uint32_t faceOf(const dvec3& p) {
    const dvec3 a = glm::abs(p);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<uint32_t>(2 * axis + (p[axis] < 0 ? 1 : 0));
}

// In a face's own axes: u, v and along.
dvec3 onFace(const dvec3& p, uint32_t face) {
    const int axis = static_cast<int>(face / 2);
    return {p[(axis + 1) % 3], p[(axis + 2) % 3], face % 2 == 0 ? p[axis] : -p[axis]};
}

// The most that a plane through `point` (light at the origin) hides of itself: how far beyond the
// depth stored at any of the four texels the moved receiver lies, over its own distance. Positive:
// in its own shadow. Both normals are units and face the light.
double selfShadow(const dvec3& point, const dvec3& plane, const dvec3& shading, uint32_t size_px) {
    const double scale = scaleOf(size_px);
    const double texel = 2 / (size_px * scale);
    const uint32_t face = faceOf(point);
    const dvec3 seen = onFace(point, face);
    const dvec3 normal = onFace(shading, face);
    const dvec3 flat = onFace(plane, face);
    const double offset = texel * seen.z *
                          (double{io::kShadowBias} + double{io::kShadowSlopeBias} *
                                                         (std::abs(normal.x) + std::abs(normal.y)));
    const dvec3 moved = seen + normal * offset;
    const auto middles = [&](double tangent) {
        const double at = (0.5 + 0.5 * scale * tangent) * size_px;
        EXPECT_GE(at, 1.0); // bilinear taps stay inside the tile
        EXPECT_LE(at, size_px - 1.0);
        const double first = std::floor(at - 0.5);
        return std::pair(((first + 0.5) / size_px - 0.5) * 2 / scale,
                         ((first + 1.5) / size_px - 0.5) * 2 / scale);
    };
    const auto [u0, u1] = middles(moved.x / moved.z);
    const auto [v0, v1] = middles(moved.y / moved.z);
    double worst = -1;
    for (const double u : {u0, u1}) {
        for (const double v : {v0, v1}) {
            // Where the texel's ray meets the plane; beyond its horizon nothing of it is stored.
            const double towards = glm::dot(flat, dvec3(u, v, 1));
            if (towards < 0) {
                const double stored = glm::dot(flat, seen) / towards;
                worst = std::max(worst, (moved.z - stored) / moved.z);
            }
        }
    }
    return worst;
}

// `normal` turned by an angle towards some other direction.
dvec3 turnedBy(const dvec3& normal, double angle, Random& random) {
    const dvec3 aside = glm::normalize(glm::cross(normal, random.direction()));
    return normal * std::cos(angle) + aside * std::sin(angle);
}

} // namespace

// At every angle, also where light grazes the plane: never beyond the comparison's own slack.
TEST(ShadowBias, APlane_IsNeverInItsOwnShadow) {
    Random random;
    for (const uint32_t size_px : {64U, 100U, 256U, 512U}) {
        double worst = -1;
        for (int i = 0; i < 50'000; ++i) {
            const dvec3 point = random.direction() * random.in(0.01, 10);
            dvec3 normal = random.direction();
            if (i % 2 == 0) { // grazing
                normal = glm::normalize(glm::cross(point, normal));
                normal = turnedBy(normal, random.in(0, 0.05), random);
            }
            normal *= glm::dot(normal, point) > 0 ? -1 : 1;
            worst = std::max(worst, selfShadow(point, normal, normal, size_px));
        }
        EXPECT_LE(worst, 1e-12) << size_px;
    }
}

// Normals that a map turns: none up to 25 degrees.
TEST(ShadowBias, TurnedNormals_AreAllowedFor) {
    Random random;
    const double most = glm::radians(25.0);
    double worst = -1;
    for (int i = 0; i < 100'000; ++i) {
        const dvec3 point = random.direction() * random.in(0.01, 10);
        dvec3 normal = random.direction();
        normal *= glm::dot(normal, point) > 0 ? -1 : 1;
        const dvec3 shading = turnedBy(normal, random.in(0, most), random);
        if (glm::dot(shading, point) < 0) {
            worst = std::max(worst, selfShadow(point, normal, shading, 256));
        }
    }
    EXPECT_LE(worst, 1e-12);
}

// What it costs: how far above a receiver a caster must be.
TEST(ShadowBias, IsAtMostThreeTexels) {
    EXPECT_LT(double{io::kShadowBias} + double{io::kShadowSlopeBias} * std::sqrt(2.0), 2.63);
}

TEST(MeetsFace, IsNeverFalseForABallThatShows) {
    Random random;
    uint32_t met = 0;
    for (int i = 0; i < 20'000; ++i) {
        const dvec3 center = random.direction() * random.in(0, 1.5);
        const double radius = random.in(0, 0.5);
        const double scale = scaleOf(64 + static_cast<uint32_t>(random.in(0, 400)));
        for (int k = 0; k < 8; ++k) {
            const dvec3 p = center + random.direction() * radius * random.in(0, 1);
            for (uint32_t face = 0; face < 6; ++face) {
                const dvec3 seen = onFace(p, face);
                if (seen.z > 0 && scale * std::max(std::abs(seen.x), std::abs(seen.y)) <= seen.z) {
                    EXPECT_TRUE(meetsFace(center, radius * (1 + 1e-9), face, scale));
                    ++met;
                }
            }
        }
    }
    EXPECT_GT(met, 50'000U);
}

TEST(MeetsFace, LeavesOutWhatLiesBehindOrBeside) {
    EXPECT_TRUE(meetsFace({0.5, 0, 0}, 0.1, 0, 0.9));
    EXPECT_FALSE(meetsFace({0.5, 0, 0}, 0.1, 1, 0.9));
    EXPECT_FALSE(meetsFace({0.5, 0, 0}, 0.1, 2, 0.9));
    EXPECT_FALSE(meetsFace({0.5, 0, 0}, 0.1, 5, 0.9));
}

TEST(ShadowPlace, Spots_HaveOneFaceUpTo60Degrees) {
    light::LightRig::Place at{.position_world = {1, 2, 3}};
    EXPECT_EQ(shadowPlace(at, 2, 256).face_count, 6U);
    at.direction_world = glm::normalize(dvec3(0.3, -0.9, 0.2));
    at.outer_cone_rad = glm::radians(60.0);
    const auto narrow = shadowPlace(at, 2, 256);
    EXPECT_EQ(narrow.face_count, 1U);
    EXPECT_NEAR(narrow.scale * std::tan(glm::radians(60.0)), 246.0 / 256, 1e-12);
    EXPECT_EQ(narrow.world_from_light[2], at.direction_world);
    const glm::dmat3 product = glm::transpose(narrow.world_from_light) * narrow.world_from_light;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(product[i][i], 1, 1e-12);
        EXPECT_NEAR(product[i][(i + 1) % 3], 0, 1e-12);
    }
    at.outer_cone_rad = glm::radians(60.1);
    EXPECT_EQ(shadowPlace(at, 2, 256).face_count, 6U);
    EXPECT_EQ(shadowPlace(at, 2, 256).world_from_light, glm::dmat3(1));
}

} // namespace froxel::render
