#include "environment/diffuse.h"
#include "environment/studio.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace froxel::environment {
namespace {

using std::numbers::pi;

double most(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Irradiance over pi by every texel's middle.
glm::dvec3 summed(const LinearImage& image, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    for (uint32_t y = 0; y < image.height_px; ++y) {
        for (uint32_t x = 0; x < image.width_px; ++x) {
            const glm::dvec3 from =
                directionAt({(x + 0.5) / image.width_px, (y + 0.5) / image.height_px});
            sum += texel(image, x, y) *
                   (std::max(0.0, glm::dot(from, normal)) * texelSolidAngle(image, y) / pi);
        }
    }
    return sum;
}

// One bright texel: row 30 of 128, column 200 of 256.
LinearImage sunOf(double irradiance) {
    LinearImage image{256, 128, std::vector<float>(size_t{3} * 256 * 128, 0)};
    const auto radiance = static_cast<float>(irradiance / texelSolidAngle(image, 30));
    std::fill_n(&image.rgb[(size_t{30} * 256 + 200) * 3], 3, radiance);
    return image;
}
const glm::dvec3 kToSun = directionAt({200.5 / 256, 30.5 / 128});

} // namespace

TEST(Diffuse, ConstantEnvironment_IsItself) {
    for (const uint32_t width : {2U, 6U, 500U}) {
        const Diffuse diffuse = diffuseOf(
            panoramaOf(width, [](const glm::dvec3&) { return glm::dvec3(0.5, 2, 1024); }));
        for (const glm::dvec3& axis : kAxes) {
            const glm::dvec3 value = diffuse.at(axis) / glm::dvec3(0.5, 2, 1024);
            EXPECT_LT(most(value - 1.0), 1e-13) << width;
        }
    }
}

// The cosine's own harmonics up to the second order: 1/4 + c/2 + 5/32 (3c^2 - 1), over pi.
TEST(Diffuse, OneSmallLight_IsTheCosinesHarmonics) {
    const Diffuse diffuse = diffuseOf(sunOf(pi));
    for (const glm::dvec3& normal :
         {kToSun, -kToSun, kAxes[0], kAxes[1], kAxes[2], kAxes[3], kAxes[4], kAxes[5]}) {
        const double c = glm::dot(normal, kToSun);
        EXPECT_NEAR(diffuse.at(normal).x, std::max(0.0, 0.25 + c / 2 + 5.0 / 32 * (3 * c * c - 1)),
                    2e-4)
            << c;
    }
    EXPECT_NEAR(diffuse.at(kToSun).x, 1.0625, 2e-4);
}

// Up to the second order nothing is lost: bands become 1, 2/3 and 1/4 of themselves.
TEST(Diffuse, SmoothEnvironment_IsExact) {
    const Diffuse diffuse = diffuseOf(panoramaOf(512, [](const glm::dvec3& d) {
        return glm::dvec3(2 + d.x + d.y * d.z, 2 + d.y + d.x * d.z, 2 + d.z + d.x * d.y) +
               (3 * d.y * d.y - 1) - (d.z * d.z - d.x * d.x);
    }));
    for (const glm::dvec3& axis : kAxes) {
        const glm::dvec3 n = glm::normalize(axis + glm::dvec3(0.3, 0.2, -0.4));
        const glm::dvec3 wanted =
            glm::dvec3(2 + n.x / 1.5 + n.y * n.z / 4, 2 + n.y / 1.5 + n.x * n.z / 4,
                       2 + n.z / 1.5 + n.x * n.y / 4) +
            (3 * n.y * n.y - 1) / 4 - (n.z * n.z - n.x * n.x) / 4;
        EXPECT_LT(most(diffuse.at(n) - wanted), 1e-4);
    }
}

TEST(Diffuse, LightOnOneSide_IsBrightestThere) {
    for (size_t lit = 0; lit < kAxes.size(); ++lit) {
        const Diffuse diffuse = diffuseOf(panoramaOf(64, [&](const glm::dvec3& direction) {
            return glm::dvec3(nearestAxis(direction) == lit ? 1 : 0);
        }));
        for (size_t other = 0; other < kAxes.size(); ++other) {
            if (other != lit) {
                EXPECT_GT(diffuse.at(kAxes[lit]).x, 3 * diffuse.at(kAxes[other]).x)
                    << lit << ' ' << other;
            }
        }
    }
}

// A quarter of the studio's soft boxes' edges is in higher bands: what they add is the error.
TEST(Diffuse, Studio_IsNearTheSumOverItsTexels) {
    const LinearImage studio = studioPanorama(128);
    const Diffuse diffuse = diffuseOf(studio);
    double most_off = 0;
    for (const glm::dvec3& axis : kAxes) {
        for (const glm::dvec3& aside : kAxes) {
            const glm::dvec3 n = glm::normalize(axis + 0.5 * aside + glm::dvec3(0.1, 0.05, 0));
            most_off = std::max(most_off, most(diffuse.at(n) - summed(studio, n)));
        }
    }
    RecordProperty("most_off", std::to_string(most_off));
    EXPECT_LT(most_off, 0.05); // of a mean of 1
}

TEST(Diffuse, Placed_IsTheTurnedPanorama) {
    const auto radiance = [](const glm::dvec3& d) {
        return glm::dvec3(std::exp(d.x + 2 * d.z), std::exp(d.y - d.x), 1 + d.x * d.z);
    };
    const LinearImage image = panoramaOf(64, radiance);
    const double angle = 2 * pi * 5 / 64; // five columns
    const LinearImage turned_image =
        panoramaOf(64, [&](const glm::dvec3& d) { return 3.0 * radiance(turned(d, -angle)); });
    const Diffuse is = placed(diffuseOf(image), angle, 3);
    const Diffuse wanted = diffuseOf(turned_image);
    for (size_t i = 0; i < is.terms.size(); ++i) {
        EXPECT_LT(most(is.terms[i] - wanted.terms[i]), 1e-6) << i;
    }
}

TEST(Diffuse, BehindASmallLight_IsNotNegative) {
    const Diffuse sun = diffuseOf(sunOf(pi));
    const double aside = -0.53; // the cosine where the harmonics are least: -0.04
    const glm::dvec3 across = glm::normalize(glm::cross(kToSun, glm::dvec3(0, 1, 0)));
    EXPECT_EQ(sun.at(kToSun * aside + across * std::sqrt(1 - aside * aside)).x, 0);
}

} // namespace froxel::environment
