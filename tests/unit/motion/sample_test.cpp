// Values between keys, against the formulas of glTF's appendix C and against closed forms.
#include "motion/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace froxel::motion {
namespace {

using scene::Interpolation;
using scene::Track;

// Of the largest term: what cancels may be smaller.
constexpr double kFourUlp = 4 * std::numeric_limits<double>::epsilon();

double sampled(const Track& track, double time_s) {
    double out = -1;
    sample(track, time_s, false, std::span(&out, 1));
    return out;
}

glm::dvec4 turned(const Track& track, double time_s) {
    glm::dvec4 out(0);
    sample(track, time_s, true, std::span(&out.x, 4));
    return out;
}

Track scalars(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
    return {interpolation, 1, std::move(times), std::move(values)};
}

TEST(Sample, Step_HoldsTheLastKey) {
    const Track track = scalars(Interpolation::kStep, {0.5F, 1, 3}, {5, 7, 11});
    EXPECT_EQ(sampled(track, -1), 5);
    EXPECT_EQ(sampled(track, 0.5), 5);
    EXPECT_EQ(sampled(track, 0.999), 5);
    EXPECT_EQ(sampled(track, 1), 7);
    EXPECT_EQ(sampled(track, 2.999), 7);
    EXPECT_EQ(sampled(track, 3), 11);
    EXPECT_EQ(sampled(track, 30), 11);
}

TEST(Sample, Linear_IsTheFormula) {
    const Track track = scalars(Interpolation::kLinear, {0.5F, 1.25F, 4}, {0.1F, -3, 10});
    EXPECT_EQ(sampled(track, 0), double{0.1F});
    EXPECT_EQ(sampled(track, 1.25), -3);
    EXPECT_EQ(sampled(track, 9), 10);
    std::mt19937_64 random(1);
    for (int i = 0; i < 1000; ++i) {
        const double time = std::uniform_real_distribution(1.25, 4.0)(random);
        const double right = -3 + (time - 1.25) / 2.75 * 13;
        EXPECT_NEAR(sampled(track, time), right, 10 * kFourUlp);
    }
}

TEST(Sample, Spline_IsTheFormula) {
    // Tangent in, value, tangent out.
    const Track track = scalars(Interpolation::kCubicSpline, {1, 3}, {100, 2, -1, 0.5F, 6, 100});
    EXPECT_EQ(sampled(track, 0), 2);
    EXPECT_EQ(sampled(track, 1), 2);
    EXPECT_EQ(sampled(track, 3), 6);
    EXPECT_EQ(sampled(track, 4), 6);
    std::mt19937_64 random(2);
    for (int i = 0; i < 1000; ++i) {
        const double time = std::uniform_real_distribution(1.0, 3.0)(random);
        // The cubic with these ends and slopes (-1 and 0.5 a second), by its power basis in
        // seconds.
        const double x = time - 1;
        const double c = -1;
        const double d = (0.5 + c - (6.0 - 2) / 2 * 2) / 4; // (m1 + m0 - 2 rise / T) / T^2
        const double b = (3 * (6.0 - 2) / 2 - 2 * c - 0.5) / 2;
        EXPECT_NEAR(sampled(track, time), 2 + x * (c + x * (b + x * d)), 20 * kFourUlp);
    }
}

TEST(Sample, SeveralNumbers_StandTogetherAKey) {
    const Track track{Interpolation::kCubicSpline, 2, {0, 1}, {0, 0, 1, 2, 0, 0, 0, 0, 5, 8, 0, 0}};
    std::array<double, 2> out{};
    sample(track, 0.5, false, out);
    EXPECT_EQ(out[0], 3); // without tangents half-way is the mean
    EXPECT_EQ(out[1], 5);
}

TEST(Sample, KeysAtOneTime_AreAJump) {
    const Track track = scalars(Interpolation::kLinear, {0, 1, 1, 2}, {0, 1, 5, 6});
    EXPECT_EQ(sampled(track, 0.5), 0.5);
    EXPECT_EQ(sampled(track, 1), 5);
    EXPECT_EQ(sampled(track, 1.5), 5.5);
    EXPECT_EQ(sampled(scalars(Interpolation::kLinear, {1, 1}, {3, 4}), 0), 3);
    EXPECT_EQ(sampled(scalars(Interpolation::kLinear, {1, 1}, {3, 4}), 1), 4);
}

TEST(Sample, OneKey_IsConstant) {
    for (const double time : {-1.0, 0.0, 2.0, 5.0}) {
        EXPECT_EQ(sampled(scalars(Interpolation::kLinear, {2}, {9}), time), 9);
        EXPECT_EQ(sampled(scalars(Interpolation::kCubicSpline, {2}, {1, 9, 1}), time), 9);
    }
}

Track turn(const glm::dvec4& from, const glm::dvec4& to) {
    Track track{Interpolation::kLinear, 4, {0, 1}, {}};
    for (const auto& q : {from, to}) {
        for (int i = 0; i < 4; ++i) {
            track.values.push_back(static_cast<float>(q[i]));
        }
    }
    return track;
}

// About x by an angle that grows evenly.
TEST(Sample, Rotation_TurnsEvenly) {
    for (const double angle : {1e-3, 0.3, 1.0, 3.0}) {
        const Track track = turn({0, 0, 0, 1}, {std::sin(angle / 2), 0, 0, std::cos(angle / 2)});
        const double stored = 2 * std::atan2(double{track.values[4]}, double{track.values[7]});
        for (const double t : {0.0, 0.125, 0.5, 0.9, 1.0}) {
            const glm::dvec4 q = turned(track, t);
            EXPECT_NEAR(q.x, std::sin(stored * t / 2), 2 * kFourUlp) << angle << " " << t;
            EXPECT_NEAR(q.w, std::cos(stored * t / 2), 2 * kFourUlp) << angle << " " << t;
        }
    }
}

TEST(Sample, Antipodes_AreOneRotation) {
    const double s = std::sin(0.4);
    const double c = std::cos(0.4);
    const Track near_way = turn({s, 0, 0, c}, {0, s, 0, c});
    const Track far_way = turn({s, 0, 0, c}, {0, -s, 0, -c});
    for (const double t : {0.25, 0.5, 0.75}) {
        const glm::dvec4 a = turned(near_way, t);
        const glm::dvec4 b = turned(far_way, t);
        EXPECT_EQ(a, b);
        EXPECT_NEAR(glm::length(a), 1, kFourUlp);
    }
    const glm::dvec4 still = turned(turn({s, 0, 0, c}, {-s, 0, 0, -c}), 0.5);
    EXPECT_NEAR(std::abs(glm::dot(still, {s, 0, 0, c})), 1, 1e-7); // keys are floats
}

TEST(Sample, RotationOfNoLength_IsNone) {
    const glm::dvec4 none(0, 0, 0, 1);
    EXPECT_EQ(turned(turn({0, 0, 0, 0}, {0, 0, 0, 0}), 0.5), none);
    EXPECT_EQ(turned(turn({0, 0, 0, 0}, {0, 0, 0, 0}), 0), none);
}

TEST(Sample, RotationOfOtherLength_IsMadeUnit) {
    Track track{Interpolation::kCubicSpline, 4, {0, 1}, {}};
    track.values = {0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0};
    const glm::dvec4 q = turned(track, 0.5); // the mean of (0, 0, 0, 2) and (2, 0, 0, 0)
    EXPECT_NEAR(q.x, std::sqrt(0.5), kFourUlp);
    EXPECT_NEAR(q.w, std::sqrt(0.5), kFourUlp);
}

} // namespace
} // namespace froxel::motion
