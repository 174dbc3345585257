#include "core/math.h"
#include "light/seeded_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace froxel::light {
namespace {

const BoundsD3 kBox{{-10, 0, -5}, {10, 8, 5}};

settings::Lights settingsOf(uint32_t count, uint32_t seed = 1) {
    settings::Lights settings;
    settings.count = count;
    settings.seed = seed;
    return settings;
}

std::vector<io::Light> lightsAt(const settings::Lights& settings,
                                double time_s,
                                const settings::Camera& camera = {},
                                const BoundsD3& box = kBox) {
    std::vector<io::Light> lights(settings.count);
    fillSeededLights(settings, camera, {box}, time_s, 0, lights.size(), lights);
    return lights;
}

// The default camera sits at the origin along -Z: view space is world space.
TEST(SeededLights, AtAnyTime_StayInTheirBox) {
    for (const double time_s : {0.0, 1.0, 12345.678, 1e6, 1e9, 1e11}) {
        for (const io::Light& light : lightsAt(settingsOf(2000), time_s)) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(light.position_view[axis], kBox.min[axis] - 1e-5);
                ASSERT_LE(light.position_view[axis], kBox.max[axis] + 1e-5);
            }
        }
    }
}

// Chi-squared of ten equal bins an axis: 9 degrees of freedom, 33.7 is exceeded once in 10,000.
TEST(SeededLights, AtAnyTime_AreUniformInTheirBox) {
    for (const double time_s : {0.0, 3.0, 60.0, 86400.0, 1e9}) {
        const auto lights = lightsAt(settingsOf(20'000), time_s);
        for (int axis = 0; axis < 3; ++axis) {
            std::array<double, 10> bins{};
            for (const io::Light& light : lights) {
                const double share = (light.position_view[axis] - kBox.min[axis]) /
                                     (kBox.max[axis] - kBox.min[axis]);
                bins[static_cast<size_t>(std::clamp(share * 10, 0.0, 9.0))] += 1;
            }
            double chi2 = 0;
            for (const double bin : bins) {
                chi2 += (bin - 2000) * (bin - 2000) / 2000;
            }
            EXPECT_LT(chi2, 33.7) << "time " << time_s << " axis " << axis;
        }
    }
}

TEST(SeededLights, Speeds_AreAsStatedAlsoAfterThirtyYears) {
    for (const double time_s : {5.0, 1e9}) {
        const double step_s = 0.015625; // exact beside 1e9
        const auto before = lightsAt(settingsOf(4000), time_s);
        const auto after = lightsAt(settingsOf(4000), time_s + step_s);
        size_t turned = 0;
        for (size_t i = 0; i < before.size(); ++i) {
            const double moved = glm::length(glm::dvec3(after[i].position_view) -
                                             glm::dvec3(before[i].position_view));
            EXPECT_LT(moved / step_s, 1.5 + 1e-3);
            turned += moved / step_s < 0.2 - 1e-3 ? 1U : 0U; // met a wall within the step
        }
        EXPECT_LT(turned, 40U);
    }
}

TEST(SeededLights, Speed_IsTheClockOwnersMatter) {
    settings::Lights settings = settingsOf(100);
    const auto a = lightsAt(settings, 7);
    settings.speed = 50;
    settings.animate = false;
    const auto b = lightsAt(settings, 7);
    for (size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].position_view, b[i].position_view);
    }
}

TEST(SeededLights, LongerLists_BeginWithTheShorter) {
    const auto few = lightsAt(settingsOf(130), 7);
    const auto many = lightsAt(settingsOf(5000), 7);
    for (size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].position_view, many[i].position_view);
        EXPECT_EQ(few[i].color, many[i].color);
    }
}

// Many lights are shared among threads, in ranges that depend on the machine.
TEST(SeededLights, ManyLights_AreTheSameAsFew) {
    const auto many = lightsAt(settingsOf(300'001), 3.5);
    for (const uint32_t count : {1U, 32'767U, 100'000U}) {
        const auto few = lightsAt(settingsOf(count), 3.5);
        ASSERT_EQ(std::memcmp(few.data(), many.data(), few.size() * sizeof(io::Light)), 0);
    }
}

TEST(SeededLights, Seeds_GiveDifferentLights) {
    const auto a = lightsAt(settingsOf(1000, 1), 0);
    const auto b = lightsAt(settingsOf(1000, 2), 0);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_NE(a[i].position_view, b[i].position_view);
    }
}

// The same bits on every machine: integers, and double arithmetic whose rounding is fixed.
TEST(SeededLights, KnownSeed_GivesKnownLights) {
    const auto lights = lightsAt(settingsOf(2, 42), 1000);
    EXPECT_EQ(lights[0].position_view, glm::vec3(6.15585279F, 7.35982037F, 0.17171137F));
    EXPECT_EQ(lights[0].color, glm::vec3(0.589224219F, 0.534444809F, 0.0883836374F));
    EXPECT_EQ(lights[1].position_view, glm::vec3(8.27807808F, 3.12995362F, -4.43685341F));
    EXPECT_EQ(lights[1].color, glm::vec3(0.694934607F, 0.109321959F, 0.728813112F));
}

TEST(SeededLights, Colors_AreSaturatedAndScaled) {
    settings::Lights settings = settingsOf(3000);
    settings.intensity = 2;
    for (const io::Light& light : lightsAt(settings, 0)) {
        const float most = std::max({light.color.x, light.color.y, light.color.z});
        const float least = std::min({light.color.x, light.color.y, light.color.z});
        EXPECT_GT(least, 0);
        EXPECT_LT(least, 0.2F * most);
        const float luminance =
            glm::dot(light.color, glm::vec3(0.2126F, 0.7152F, 0.0722F)) / settings.intensity;
        EXPECT_GT(luminance, 0.5F * 0.3F);
        EXPECT_LT(luminance, 1.5F * 0.7F);
    }
}

// Where they are and how bright stays; at 6,500 K a black body is about white.
TEST(SeededLights, Palettes_AreThoseOfTheirTemperatures) {
    settings::Lights settings = settingsOf(3000);
    const auto rainbow = lightsAt(settings, 7);
    using settings::LightPalette;
    for (const auto palette : {LightPalette::kWarm, LightPalette::kWhite, LightPalette::kCool}) {
        settings.palette = palette;
        const auto lights = lightsAt(settings, 7);
        for (size_t i = 0; i < lights.size(); ++i) {
            ASSERT_EQ(lights[i].position_view, rainbow[i].position_view);
            const glm::vec3& color = lights[i].color;
            const float luminance = glm::dot(color, glm::vec3(0.2126F, 0.7152F, 0.0722F));
            ASSERT_GT(luminance, 0.5F * 0.4F);
            ASSERT_LT(luminance, 1.5F * 0.71F);
            const glm::vec3 of_most = color / std::max({color.x, color.y, color.z});
            switch (palette) {
            case LightPalette::kWarm: // a bulb's green is 0.48 of its red, a flame's 0.2
                ASSERT_EQ(of_most.x, 1);
                ASSERT_GT(of_most.y, 0.15F);
                ASSERT_LT(of_most.y, 0.55F);
                ASSERT_LT(of_most.z, 0.2F);
                break;
            case LightPalette::kWhite:
                ASSERT_GT(std::min({of_most.x, of_most.y, of_most.z}), 0.5F);
                break;
            default:
                ASSERT_EQ(of_most.z, 1);
                ASSERT_GT(of_most.y, of_most.x);
                ASSERT_LT(of_most.x, 0.7F);
                ASSERT_GT(of_most.x, 0.3F);
            }
        }
    }
}

TEST(SeededLights, FlatAndEmptyBoxes_GiveFinitePositions) {
    const BoundsD3 boxes[] = {{{1, 2, 3}, {1, 2, 3}}, {{0, 0, 0}, {5, 0, 1e-9}}};
    for (const BoundsD3& box : boxes) {
        for (const io::Light& light : lightsAt(settingsOf(200), 1e9, {}, box)) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_NEAR(light.position_view[axis], box.min[axis], box.size()[axis] + 1e-6);
            }
        }
    }
}

TEST(SeededLights, InverseRadius_IsFiniteForEveryRadius) {
    EXPECT_FLOAT_EQ(inverseRadius2(2), 0.25F);
    EXPECT_TRUE(std::isfinite(inverseRadius2(1e-30)));
    EXPECT_TRUE(std::isfinite(inverseRadius2(0)));
    EXPECT_EQ(inverseRadius2(std::numeric_limits<double>::infinity()), 0.0F);
}

// The far-away scene is the same picture: positions are made relative in double.
TEST(SeededLights, SceneFarFromTheOrigin_LooksTheSame) {
    const auto settings = settingsOf(500);
    const auto near_camera = settings::lookAt({-7.13, 2.29, 0.41}, {0, 2, 1}, {0, 1, 0});
    const auto at_home = lightsAt(settings, 12, near_camera);
    for (const double distance : {1e4 + 0.37, 1e6 + 0.37}) {
        const glm::dvec3 offset(distance, -distance, distance);
        settings::Camera camera = near_camera;
        camera.eye_world += offset;
        const auto away = lightsAt(settings, 12, camera, {kBox.min + offset, kBox.max + offset});
        for (size_t i = 0; i < away.size(); ++i) {
            EXPECT_LT(glm::distance(away[i].position_view, at_home[i].position_view), 5e-6F);
        }
    }
}

} // namespace
} // namespace froxel::light
