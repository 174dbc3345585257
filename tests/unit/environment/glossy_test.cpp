#include "environment/albedo.h"
#include "environment/glossy.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace froxel::environment {
namespace {

using std::numbers::pi;

// Over directions of light rather than of microfacets, by midpoints of equal solid angles.
Albedo summed(double n_dot_v, double roughness, int count) {
    const double alpha2 = std::pow(roughness, 4);
    const glm::dvec3 to_eye(std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v);
    Albedo sum;
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < count; ++k) {
            const double z = (i + 0.5) / count;
            const double around = pi * (k + 0.5) / count;
            const glm::dvec3 to_light(std::sqrt(1 - z * z) * std::cos(around),
                                      std::sqrt(1 - z * z) * std::sin(around), z);
            const glm::dvec3 half = glm::normalize(to_eye + to_light);
            const double value = lobes::distribution(half.z, alpha2) *
                                 lobes::visibility(z, n_dot_v, alpha2) * z * 2 * pi /
                                 (static_cast<double>(count) * count);
            sum.all += value;
            sum.grazing += value * std::pow(1 - glm::dot(half, to_eye), 5);
        }
    }
    return sum;
}

} // namespace

// With alpha = 1 the integral has a closed form.
TEST(GgxAlbedo, OfTheRoughest_IsTheClosedForm) {
    for (const double u : {1e-3, 0.01, 0.1, 0.3, 0.6, 1.0}) {
        EXPECT_NEAR(albedo(u, 1).all, 1 - u * std::log(1 + 1 / u), u < 0.01 ? 1e-3 : 1e-4) << u;
    }
}

TEST(GgxAlbedo, IsTheSumOverLight) {
    for (const double roughness : {0.5, 0.8}) {
        for (const double u : {0.1, 0.5, 1.0}) {
            const Albedo is = albedo(u, roughness);
            const Albedo wanted = summed(u, roughness, 400);
            EXPECT_NEAR(is.all, wanted.all, 3e-4) << roughness << ' ' << u;
            EXPECT_NEAR(is.grazing, wanted.grazing, 3e-4) << roughness << ' ' << u;
        }
    }
}

TEST(GgxAlbedo, OfTheSmoothest_IsOne) {
    for (const double u : {0.1, 0.5, 1.0}) {
        EXPECT_NEAR(albedo(u, 0.03).all, 1, 1e-3) << u;
        EXPECT_NEAR(albedo(u, 0.03).grazing, std::pow(1 - u, 5), 1e-3) << u;
    }
}

// Between entries, where it is worst.
TEST(GgxAlbedo, IsInTheTable) {
    EXPECT_EQ(albedoTable().size(), size_t{2} * kAlbedoTableSize * kAlbedoTableSize);
    double most = 0;
    double most_at_edge = 0; // below n.v = 0.01
    for (const double roughness :
         {0.045, 0.052, 0.06, 0.08, 0.11, 0.17, 0.27, 0.41, 0.63, 0.91, 1.0}) {
        for (const double u : {0.0005, 0.002, 0.0035, 0.006, 0.012, 0.022, 0.035, 0.057, 0.085,
                               0.12, 0.21, 0.35, 0.6, 0.9, 1.0}) {
            const Albedo is = albedoFromTable(u, roughness);
            const Albedo wanted = albedo(u, roughness);
            double& worst = u < 0.01 ? most_at_edge : most;
            worst = std::max(
                {worst, std::abs(is.all - wanted.all), std::abs(is.grazing - wanted.grazing)});
        }
    }
    RecordProperty("most", std::to_string(most));
    RecordProperty("most_at_edge", std::to_string(most_at_edge));
    EXPECT_LT(most, 0.003);
    EXPECT_LT(most_at_edge, 0.01);
}

// The white furnace: whatever is in it, nothing gets brighter, and what absorbs nothing is unseen.
TEST(ReflectedShare, WhiteFurnace) {
    for (const double roughness : {0.045, 0.1, 0.3, 0.5, 0.7, 1.0}) {
        for (const double u : {0.01, 0.1, 0.5, 1.0}) {
            const Albedo lobe = albedoFromTable(u, roughness);
            EXPECT_NEAR(reflectedShare(1, lobe), 1, 1e-12);
            double before = reflectedShare(0, lobe);
            EXPECT_EQ(before, lobe.grazing);
            for (const double f0 : {0.04, 0.3, 0.8, 0.99}) {
                const double share = reflectedShare(f0, lobe);
                EXPECT_GT(share, before) << roughness << ' ' << u << ' ' << f0;
                EXPECT_LT(share, 1) << roughness << ' ' << u << ' ' << f0;
                before = share;
            }
        }
    }
}

TEST(MeanOfLobe, ConstantEnvironment_IsItself) {
    const LinearImage image = panoramaOf(8, [](const glm::dvec3&) { return glm::dvec3(3); });
    for (const double roughness : {0.05, 0.5, 1.0}) {
        EXPECT_NEAR(meanOfLobe(image, {0, 0, 1}, roughness, 64).x, 3, 1e-12);
    }
}

// With alpha = 1 the cosine t to the light is evenly spread, and weighted by t / (1 + t).
TEST(MeanOfLobe, OfTheRoughest_IsTheClosedForm) {
    for (const glm::dvec3& axis : kAxes) {
        const LinearImage image =
            panoramaOf(512, [&](const glm::dvec3& d) { return glm::dvec3(1 + glm::dot(d, axis)); });
        EXPECT_NEAR(meanOfLobe(image, axis, 1, 1 << 12).x,
                    1 + (std::log(2) - 0.5) / (1 - std::log(2)), 1e-3);
    }
}

TEST(MeanOfLobe, OfASmoothSurface_IsTheRadianceThere) {
    const LinearImage image = panoramaOf(
        64, [](const glm::dvec3& d) { return glm::dvec3(static_cast<double>(nearestAxis(d))); });
    for (size_t i = 0; i < kAxes.size(); ++i) {
        EXPECT_NEAR(meanOfLobe(image, kAxes[i], 0.05, 256).x, static_cast<double>(i), 0.01);
    }
}

} // namespace froxel::environment
