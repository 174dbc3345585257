// The reference's light sums against closed forms.
#include "reference/brdf.h"
#include "reference/toon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace froxel::reference {
namespace {

constexpr double kPi = std::numbers::pi;
const Model kPbr{};
const Model kLambert{settings::ShadingModel::kLambert, nullptr};
const Model kBlinnPhong{settings::ShadingModel::kBlinnPhong, nullptr};

glm::dvec3 direction(double from_up_rad, double turn_rad) {
    return {std::sin(from_up_rad) * std::cos(turn_rad), std::cos(from_up_rad),
            std::sin(from_up_rad) * std::sin(turn_rad)};
}

Surface seenFrom(const glm::dvec3& to_eye) {
    Surface s;
    s.to_eye = glm::normalize(to_eye);
    return s;
}

// Of light of radiance 1 from everywhere; midpoint rule, dense around the mirror direction.
double albedo(const Surface& s, const Model& model) {
    const glm::dvec3 mirror(-s.to_eye.x, s.to_eye.y, -s.to_eye.z);
    constexpr int kRings = 2000;
    constexpr int kTurns = 256;
    const glm::dvec3 side = glm::normalize(glm::cross(mirror, glm::dvec3(0.3, 0.2, 0.9)));
    const glm::dvec3 other = glm::cross(mirror, side);
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const double share = (i + 0.5) / kRings;
        const double angle = kPi * share * share * share; // from the mirror direction
        const double width = 3 * kPi * share * share / kRings;
        for (int j = 0; j < kTurns; ++j) {
            const double turn = 2 * kPi * (j + 0.5) / kTurns;
            const glm::dvec3 l = mirror * std::cos(angle) +
                                 (side * std::cos(turn) + other * std::sin(turn)) * std::sin(angle);
            sum += reflected(s, model, l).x * std::sin(angle) * width * 2 * kPi / kTurns;
        }
    }
    return sum;
}

TEST(ReferenceBrdf, LambertUnderOneLight_IsAlbedoOverPiTimesCosineOverDistanceSquared) {
    Surface s = seenFrom({1, 1, 0});
    s.base_color = {0.5, 0.25, 1};
    Lights lights;
    lights.points.push_back({.position = {3, 4, 0}, .color = {10, 20, 40}});
    const glm::dvec3 out = radiance(s, kLambert, lights);
    const double share = 0.8 / 25 / kPi;
    EXPECT_NEAR(out.x, 5 * share, 1e-15);
    EXPECT_NEAR(out.y, 5 * share, 1e-15);
    EXPECT_NEAR(out.z, 40 * share, 1e-15);
}

TEST(ReferenceBrdf, Attenuation_AtTheRadiusAndBelowOneCentimetre_FollowsItsFormula) {
    const PointLight light{.radius2 = 4};
    EXPECT_EQ(attenuation(light, {0, 2, 0}), 0);
    EXPECT_EQ(attenuation(light, {0, 2.5, 0}), 0);
    EXPECT_GT(attenuation(light, {0, std::nextafter(2.0, 0.0), 0}), 0);
    EXPECT_NEAR(attenuation(light, {0, 1, 0}), std::pow(1 - 1.0 / 16, 2), 1e-15);
    EXPECT_NEAR(attenuation(light, {0, 1e-3, 0}), 1e4, 1e-8);
    EXPECT_NEAR(attenuation({.radius2 = 4, .nearest_m = 1e-3}, {0, 2e-3, 0}), 1 / 4e-6, 1e-5);
    EXPECT_NEAR(attenuation({.radius2 = 4, .nearest_m = 1e-3}, {0, 1e-5, 0}), 1e6, 1e-8);
    EXPECT_EQ(attenuation(light, {0, 0, 0}), 0);
    EXPECT_NEAR(attenuation(PointLight{}, {0, 1e3, 0}), 1e-6, 1e-20);
}

// Full inside the inner cone, none outside the outer, squared linear in the cosine between.
TEST(ReferenceBrdf, SpotFalloff_BetweenItsCones_IsSquaredLinearInTheCosine) {
    const double inner = std::cos(0.3);
    const double outer = std::cos(0.6);
    PointLight light;
    light.direction = {0, -1, 0};
    light.cone_scale = 1 / (inner - outer);
    light.cone_offset = -outer * light.cone_scale;
    EXPECT_NEAR(attenuation(light, direction(0.29, 1)), 1, 1e-12);
    EXPECT_EQ(attenuation(light, direction(0.61, 1)), 0);
    const double share = (std::cos(0.4) - outer) / (inner - outer);
    EXPECT_NEAR(attenuation(light, direction(0.4, 2)), share * share, 1e-12);
}

// By hand: n = l = v, so h = n, D = 1 / (pi a^2), V = 1 / 4, F = f0.
TEST(ReferenceBrdf, PbrHeadOn_IsDiffuseAndAQuarterOfTheDistribution) {
    Surface s = seenFrom({0, 1, 0});
    s.base_color = {0.8, 0.4, 0.2};
    s.roughness = 0.5;
    s.metallic = 0;
    const glm::dvec3 out = reflected(s, kPbr, {0, 1, 0});
    const double lobe = 1 / (kPi * std::pow(0.5, 4)) / 4;
    EXPECT_NEAR(out.x, 0.96 * 0.8 / kPi + 0.04 * lobe, 1e-14);
    s.metallic = 1;
    EXPECT_NEAR(reflected(s, kPbr, {0, 1, 0}).y, 0.4 * lobe, 1e-14);
}

// Appendix B mixes a dielectric and a metal that are whole: head-on the one scatters 1 - 0.04,
// however little of it there is, and the lobes' reflectances mix.
TEST(ReferenceBrdf, HalfAMetal_IsTheMeanOfADielectricAndAMetal) {
    Surface s = seenFrom({0, 1, 0});
    s.base_color = {0.8, 0.4, 0.2};
    s.roughness = 0.5;
    s.metallic = 0.5;
    const double lobe = 1 / (kPi * std::pow(0.5, 4)) / 4;
    EXPECT_NEAR(reflected(s, kPbr, {0, 1, 0}).x, 0.48 * 0.8 / kPi + 0.42 * lobe, 1e-14);
    for (const double angle : {0.3, 0.9, 1.4}) {
        s.to_eye = direction(angle, 0.5);
        const glm::dvec3 to_light = direction(0.8, 2.7);
        const auto at = [&](double metallic) {
            s.metallic = metallic;
            return reflected(s, kPbr, to_light);
        };
        const glm::dvec3 mean = (at(0) + at(1)) * 0.5;
        EXPECT_LT(glm::distance(at(0.5), mean), 1e-14) << angle;
    }
}

// Without strength nothing is reflected: Lambert's surface.
TEST(ReferenceBrdf, DielectricWithoutStrength_IsLambert) {
    Surface s = seenFrom(direction(0.7, 0.5));
    s.base_color = {0.8, 0.4, 0.2};
    s.dielectric_f0 = glm::dvec3(0);
    s.dielectric_f90 = 0;
    for (const double angle : {0.0, 0.8, 1.5}) {
        const glm::dvec3 to_light = direction(angle, 2.6);
        EXPECT_LT(glm::distance(reflected(s, kPbr, to_light), reflected(s, kLambert, to_light)),
                  1e-15);
    }
    s.base_color = glm::dvec3(1);
    EXPECT_NEAR(albedo(s, kPbr), 1, 1e-4);
}

// An index without end reflects all: the metal of that colour, and nothing is left to scatter.
TEST(ReferenceBrdf, DielectricOfInfiniteIndex_IsAWhiteMetal) {
    for (const double roughness : {0.3, 1.0}) {
        Surface s = seenFrom(direction(0.7, 0.5));
        s.roughness = roughness;
        s.base_color = {0.8, 0.4, 0.2};
        s.dielectric_f0 = glm::dvec3(1);
        Surface metal = s;
        metal.base_color = glm::dvec3(1);
        metal.metallic = 1;
        const glm::dvec3 to_light = direction(0.9, 2.6);
        EXPECT_LT(glm::distance(reflected(s, kPbr, to_light), reflected(metal, kPbr, to_light)),
                  1e-14);
    }
}

// By hand: head-on F is f0, and scattered is what its largest channel leaves of each.
TEST(ReferenceBrdf, ColoredDielectric_ScattersWhatItsStrongestChannelLeaves) {
    Surface s = seenFrom({0, 1, 0});
    s.base_color = {0.8, 0.4, 0.2};
    s.roughness = 0.5;
    s.dielectric_f0 = {0.1, 0.3, 0.2};
    s.dielectric_f90 = 0.5;
    const double lobe = 1 / (kPi * std::pow(0.5, 4)) / 4;
    const glm::dvec3 out = reflected(s, kPbr, {0, 1, 0});
    EXPECT_NEAR(out.x, 0.7 * 0.8 / kPi + 0.1 * lobe, 1e-14);
    EXPECT_NEAR(out.y, 0.7 * 0.4 / kPi + 0.3 * lobe, 1e-14);
    // Half a right angle on both sides of the normal: l.h = 1 / sqrt(2).
    s.to_eye = direction(kPi / 4, 0);
    const double q = std::pow(1 - std::sqrt(0.5), 5);
    s.base_color = glm::dvec3(0);
    const double green = reflected(s, kPbr, direction(kPi / 4, kPi)).y;
    s.dielectric_f90 = 1;
    s.dielectric_f0 = glm::dvec3(1);
    const double all = reflected(s, kPbr, direction(kPi / 4, kPi)).y;
    EXPECT_NEAR(green / all, 0.3 + (0.5 - 0.3) * q, 1e-14);
}

// Not at grazing angles, where glTF's coupling of what is scattered returns up to 15 % too much.
TEST(ReferenceBrdf, WhiteDielectricInAFurnace_ReturnsAtMostAll) {
    for (const double f0 : {0.04, 0.5}) {
        for (const double strength : {0.3, 1.0}) {
            for (const double angle : {0.0, 0.7}) {
                Surface s = seenFrom(direction(angle, 0.5));
                s.roughness = 0.3;
                s.dielectric_f0 = glm::dvec3(f0 * strength);
                s.dielectric_f90 = strength;
                const double returned = albedo(s, kPbr);
                EXPECT_LE(returned, 1.001) << f0 << " " << strength << " " << angle;
                EXPECT_GE(returned, 0.85) << f0 << " " << strength << " " << angle;
            }
        }
    }
}

// By hand: n = l = v, so the coat takes 0.04 of its strength, and h = n.
TEST(ReferenceBrdf, CoatHeadOn_DimsWhatIsBelowAndAddsItsLobe) {
    Surface s = seenFrom({0, 1, 0});
    s.base_color = {0.8, 0.4, 0.2};
    s.roughness = 1;
    const glm::dvec3 below = reflected(s, kPbr, {0, 1, 0});
    s.coat.strength = 0.5;
    s.coat.roughness = 0.5;
    const double lobe = 1 / (kPi * std::pow(0.5, 4)) / 4;
    const glm::dvec3 out = reflected(s, kPbr, {0, 1, 0});
    EXPECT_NEAR(out.x, 0.98 * below.x + 0.02 * lobe, 1e-14);
    EXPECT_NEAR(out.z, 0.98 * below.z + 0.02 * lobe, 1e-14);
    EXPECT_EQ(reflected(s, kLambert, {0, 1, 0}).x, 0.8 / kPi);
    // What a surface sends by itself is below the coat, too.
    s.emissive = {3, 2, 1};
    EXPECT_NEAR(radiance(s, kPbr, Lights{}).x, 0.98 * 3, 1e-14);
}

// Its own normal says what faces it, and how much of it the eye sees.
TEST(ReferenceBrdf, CoatOfItsOwnNormal_IsLitByWhatItFaces) {
    Surface s = seenFrom(direction(0.3, 0));
    s.base_color = glm::dvec3(0.5);
    s.roughness = 0.4;
    s.coat.strength = 1;
    s.coat.roughness = 0.4;
    const glm::dvec3 to_light = direction(1.9, kPi); // from below the surface
    EXPECT_EQ(reflected(s, kPbr, to_light).x, 0);
    s.coat.normal = direction(0.8, kPi);
    const double share = 0.04 + 0.96 * std::pow(1 - std::cos(1.1), 5);
    // A metal whose f0 is 1 reflects the lobe as it is.
    Surface metal = seenFrom(s.to_eye);
    metal.normal = s.coat.normal;
    metal.metallic = 1;
    metal.roughness = 0.4;
    EXPECT_NEAR(reflected(s, kPbr, to_light).x, share * reflected(metal, kPbr, to_light).x, 1e-14);
    EXPECT_GT(reflected(s, kPbr, to_light).x, 0.01);
}

// At roughness 1 the lobe reflects 1 - u ln(1 + 1 / u) of what comes, u = n.v; below it a black
// surface adds nothing and a white one what the coat lets through.
TEST(ReferenceBrdf, CoatInAFurnace_ReturnsItsClosedForm) {
    for (const double angle : {0.0, 0.7, 1.2}) {
        const double u = std::cos(angle);
        Surface s = seenFrom(direction(angle, 0.5));
        s.dielectric_f0 = glm::dvec3(0);
        s.dielectric_f90 = 0;
        s.base_color = glm::dvec3(0);
        s.coat.strength = 0.8;
        s.coat.roughness = 1;
        const double share = 0.8 * (0.04 + 0.96 * std::pow(1 - u, 5));
        const double lobe = 1 - u * std::log(1 + 1 / u);
        EXPECT_NEAR(albedo(s, kPbr), share * lobe, 2e-4);
        s.base_color = glm::dvec3(1);
        EXPECT_NEAR(albedo(s, kPbr), 1 - share * (1 - lobe), 2e-4);
        s.coat.roughness = 0.1;
        EXPECT_LT(albedo(s, kPbr), 1 + 1e-4);
        EXPECT_GT(albedo(s, kPbr), 1 - 0.1 * share);
    }
}

// Numbers of an integration elsewhere, to their digits.
TEST(ReferenceBrdf, SheenAlbedo_IsTheIntegral) {
    const double cosines[] = {0.1, 0.3, 0.5, 0.75};
    const double albedos[][4] = {
        {0.549, 0.188, 0.060, 0.010}, {0.567, 0.321, 0.188, 0.089}, {0.721, 0.491, 0.356, 0.246}};
    for (const auto& [row, roughness] :
         {std::pair(size_t{0}, 0.25), std::pair(size_t{1}, 0.5), std::pair(size_t{2}, 1.0)}) {
        for (size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(sheenAlbedo(cosines[i], roughness), albedos[row][i], 2.5e-3);
        }
    }
}

// White fibres on a white surface return what comes, as the surface alone would: less by none.
TEST(ReferenceBrdf, SheenInAFurnace_ReturnsWhatItTakes) {
    for (const double roughness : {0.3, 0.6, 1.0}) {
        for (const double angle : {0.0, 0.7, 1.2, 1.45}) {
            Surface s = seenFrom(direction(angle, 0.5));
            s.dielectric_f0 = glm::dvec3(0);
            s.dielectric_f90 = 0;
            s.sheen = {glm::dvec3(0.8, 0.8, 0.8), roughness};
            EXPECT_NEAR(albedo(s, kPbr), 1, 4e-3) << roughness << " at " << angle;
            s.base_color = glm::dvec3(0);
            EXPECT_NEAR(albedo(s, kPbr), 0.8 * sheenAlbedo(std::cos(angle), roughness), 4e-3);
        }
    }
    // By its formula the smoothest sheen would return three times what comes.
    Surface s = seenFrom(direction(1.565, 0.5));
    s.base_color = glm::dvec3(0);
    s.dielectric_f0 = glm::dvec3(0);
    s.dielectric_f90 = 0;
    s.sheen = {glm::dvec3(1), 0};
    EXPECT_GT(sheenAlbedo(std::cos(1.565), 0), 2);
    EXPECT_LT(albedo(s, kPbr), 1.02);
}

// By hand: what comes through is a matt surface's of the other side, by Fresnel's term of an eye
// that is mirrored there; on its own side as much is missing. There and back it is the same.
TEST(ReferenceBrdf, LightFromBehind_IsScatteredByTheOtherColor) {
    Surface s = seenFrom({0, 1, 0});
    s.base_color = {0.8, 0.4, 0.2};
    s.diffuse_transmission = {0.25, {0.5, 1, 0}};
    EXPECT_LT(
        glm::distance(reflected(s, kPbr, {0, -1, 0}), glm::dvec3(0.5, 1, 0) * (0.25 * 0.96 / kPi)),
        1e-15);
    Surface opaque = s;
    opaque.diffuse_transmission.strength = 0;
    EXPECT_EQ(reflected(opaque, kPbr, {0, -1, 0}), glm::dvec3(0));
    const glm::dvec3 missing = reflected(opaque, kPbr, {0, 1, 0}) - reflected(s, kPbr, {0, 1, 0});
    EXPECT_LT(glm::distance(missing, s.base_color * (0.25 * 0.96 / kPi)), 1e-15);
    s.metallic = 1;
    EXPECT_EQ(reflected(s, kPbr, {0, -1, 0}), glm::dvec3(0)) << "metals let nothing through";
    s.metallic = 0;
    EXPECT_EQ(reflected(s, kLambert, {0, -1, 0}), glm::dvec3(0)) << "Lambert knows none";
    for (const double angle : {0.3, 1.0, 1.5}) {
        const glm::dvec3 to_eye = direction(angle, 0.5);
        const glm::dvec3 to_light = -direction(0.8, 2.0);
        s.to_eye = to_eye;
        const glm::dvec3 there = reflected(s, kPbr, to_light) / std::abs(to_light.y);
        s.to_eye = -to_light;
        const glm::dvec3 back = reflected(s, kPbr, -to_eye) / std::abs(to_eye.y);
        EXPECT_LT(glm::distance(there, back), 1e-14) << angle;
    }
}

// By hand: D = (2 + 1 / alpha) sin^(1 / alpha) / 2 pi with alpha = 1.
TEST(ReferenceBrdf, SheenOfRoughnessOne_IsASine) {
    Surface s = seenFrom(direction(0.8, 0));
    s.base_color = glm::dvec3(0);
    s.dielectric_f0 = glm::dvec3(0);
    s.dielectric_f90 = 0;
    s.sheen = {{1, 0.5, 0}, 1};
    const double lambda =
        std::exp(2 * (21.5473 / (1 + 3.82987 * std::pow(0.5, 0.19823)) - 1.97760 * 0.5 - 4.32054) -
                 (21.5473 / (1 + 3.82987 * std::pow(1 - std::cos(0.8), 0.19823)) -
                  1.97760 * (1 - std::cos(0.8)) - 4.32054));
    const double expected = 3 * std::sin(0.8) / (2 * kPi) / ((1 + 2 * lambda) * 4 * std::cos(0.8));
    const glm::dvec3 out = reflected(s, kPbr, direction(0.8, 0));
    EXPECT_NEAR(out.x, expected, 1e-12);
    EXPECT_NEAR(out.y, expected / 2, 1e-12);
    EXPECT_EQ(out.z, 0);
    EXPECT_EQ(reflected(s, kLambert, direction(0.8, 0)).x, 0);
}

// By hand: h = n, where D = 1 / (pi at ab) and V = 1 / 4.
TEST(ReferenceBrdf, AnisotropyHeadOn_IsAsHighAsItsAreaSays) {
    Surface s = seenFrom({0, 1, 0});
    s.metallic = 1;
    s.roughness = 0.5;
    s.anisotropy = {0.6, {0.3, 5, 0.4}}; // is brought onto the surface
    const double at = 0.25 + 0.75 * 0.36;
    EXPECT_NEAR(reflected(s, kPbr, {0, 1, 0}).x, 1 / (kPi * at * 0.25) / 4, 1e-14);
    // Half a radian off along the longer axis and along the other.
    const glm::dvec3 along(0.6, 0, 0.8);
    const glm::dvec3 across(0.8, 0, -0.6);
    const auto towards = [&](const glm::dvec3& side) {
        return reflected(s, kPbr, side * std::sin(0.5) + glm::dvec3(0, std::cos(0.5), 0)).x;
    };
    EXPECT_GT(towards(along), 2 * towards(across));
    EXPECT_NEAR(towards(along), towards(-along), 1e-14);
    // Blinn's lobe is round, whatever the material's.
    const double blinn = reflected(s, kBlinnPhong, direction(0.5, 0)).x;
    s.anisotropy.strength = 0;
    EXPECT_EQ(blinn, reflected(s, kBlinnPhong, direction(0.5, 0)).x);
}

// A white metal returns no more than comes, whichever way its highlights are long; and light and
// eye may be swapped.
TEST(ReferenceBrdf, AnisotropyInAFurnace_ReturnsAtMostAll) {
    for (const double strength : {0.3, 1.0}) {
        for (const double turn : {0.0, 0.8, 1.57}) {
            for (const double angle : {0.0, 0.7, 1.2}) {
                Surface s = seenFrom(direction(angle, 0.5 + turn));
                s.metallic = 1;
                s.roughness = 0.5;
                s.anisotropy = {strength, {std::cos(0.5), 0, std::sin(0.5)}};
                EXPECT_LE(albedo(s, kPbr), 1.001) << strength << " " << turn << " " << angle;
                const glm::dvec3 eye = s.to_eye;
                const glm::dvec3 light = direction(0.4, 2.5);
                const double there = reflected(s, kPbr, light).x / light.y;
                s.to_eye = light;
                EXPECT_NEAR(reflected(s, kPbr, eye).x / eye.y, there, 1e-12);
            }
        }
    }
}

// Where nothing interferes a film is two borders: outer and inner, and all that goes to and fro.
TEST(ReferenceBrdf, ThickFilm_IsTwoBorders) {
    const double outer = std::pow(0.5 / 2.5, 2);
    const double inner = std::pow(0.5 / 3.5, 2); // a base of 2, head-on
    const double expected = outer + inner * std::pow(1 - outer, 2) / (1 - outer * inner);
    const glm::dvec3 base_f0(1.0 / 9);
    const glm::dvec3 thick = filmReflects({1, 1.5, 1e6}, base_f0, 1);
    EXPECT_NEAR(thick.x, expected, 1e-6);
    EXPECT_NEAR(thick.z, expected, 1e-6);
    // A film of no thickness is none.
    EXPECT_NEAR(filmReflects({1, 1.5, 0}, base_f0, 1).y, 1.0 / 9, 1e-12);
    // One of a quarter wave and the root of the base's index lets green through.
    EXPECT_LT(filmReflects({1, std::sqrt(2.0), 550 / 4 / std::sqrt(2.0)}, base_f0, 1).y, 0.01);
    EXPECT_GT(filmReflects({1, std::sqrt(2.0), 550 / 2 / std::sqrt(2.0)}, base_f0, 1).y, 0.1);
}

// Never more than comes; of a white metal nearly all.
TEST(ReferenceBrdf, FilmInAFurnace_ReturnsAtMostAll) {
    for (const double thickness_nm : {0.0, 150.0, 400.0, 1200.0, 5000.0}) {
        for (const double angle : {0.0, 0.7, 1.2}) {
            Surface s = seenFrom(direction(angle, 0.5));
            s.roughness = 0.3;
            s.film = {1, 1.5, thickness_nm};
            s.metallic = 1;
            EXPECT_LE(albedo(s, kPbr), 1.001);
            EXPECT_GE(albedo(s, kPbr), 0.85);
            s.metallic = 0;
            EXPECT_LE(albedo(s, kPbr), 1.001);
            s.film.strength = 0.5;
            EXPECT_LE(albedo(s, kPbr), 1.05); // glTF's own coupling, as above
        }
    }
}

TEST(ReferenceBrdf, PbrLobe_SwappingLightAndEye_GivesTheSame) {
    Surface s = seenFrom(direction(0.9, 0.2));
    s.metallic = 1; // the diffuse part's Fresnel term is symmetric too, but say so for the lobe
    s.roughness = 0.35;
    const glm::dvec3 light = direction(0.4, 2.5);
    const double there = reflected(s, kPbr, light).x / light.y;
    const glm::dvec3 eye = s.to_eye;
    s.to_eye = light;
    EXPECT_NEAR(reflected(s, kPbr, eye).x / eye.y, there, 1e-13);
}

// White furnace: a surface never returns more than it gets, almost all of it where it is smooth; by
// single scattering 1 - ln 2 head-on at roughness 1, where the integral has a closed form.
TEST(ReferenceBrdf, WhiteMetalInAFurnace_ReturnsAtMostAll) {
    for (const double roughness : {0.1, 0.3, 0.6, 1.0}) {
        for (const double angle : {0.0, 0.7, 1.3}) {
            Surface s = seenFrom(direction(angle, 0.5));
            s.metallic = 1;
            s.roughness = roughness;
            const double returned = albedo(s, kPbr);
            EXPECT_LE(returned, 1.001) << roughness << " " << angle;
            EXPECT_GE(returned, roughness < 0.2 ? 0.97 : 0.3) << roughness << " " << angle;
        }
    }
    Surface s = seenFrom({0, 1, 0});
    s.metallic = 1;
    EXPECT_NEAR(albedo(s, kPbr), 1 - std::numbers::ln2, 1e-4);
    EXPECT_NEAR(albedo(s, kLambert), 1, 1e-4);
}

// The lobe is scaled to return all of what comes head-on, whatever the roughness, and returns less
// from the side, where half of it lies below the surface: no masking makes up for that.
TEST(ReferenceBrdf, WhiteBlinnPhongMetalInAFurnace_ReturnsAllHeadOnAndNeverMore) {
    for (const double roughness : {0.1, 0.3, 0.6, 1.0}) {
        Surface s = seenFrom({0, 1, 0});
        s.metallic = 1;
        s.roughness = roughness;
        EXPECT_NEAR(albedo(s, kBlinnPhong), 1, 1e-3) << roughness;
        for (const double angle : {0.7, 1.3}) {
            s.to_eye = direction(angle, 0.5);
            const double returned = albedo(s, kBlinnPhong);
            EXPECT_LE(returned, 1.001) << roughness << " " << angle;
            EXPECT_GE(returned, 0.05) << roughness << " " << angle;
        }
    }
}

// By hand: roughness 1 gives the exponent 0, a lobe of 1 / pi everywhere; roughness 0.5 gives 30.
TEST(ReferenceBrdf, BlinnPhong_OfKnownExponents_IsItsFormula) {
    Surface s = seenFrom(direction(0.4, 0));
    s.metallic = 1;
    EXPECT_NEAR(reflected(s, kBlinnPhong, direction(0.4, kPi)).x, std::cos(0.4) / kPi, 1e-12);
    s.roughness = 0.5;
    const double peak = 32.0 * 34.0 / (8 * kPi * (30 + std::pow(2.0, -15)));
    EXPECT_NEAR(reflected(s, kBlinnPhong, direction(0.4, kPi)).x, std::cos(0.4) * peak, 1e-12);
    EXPECT_NEAR(reflected(s, kBlinnPhong, direction(0.2, 0)).x,
                std::cos(0.2) * peak * std::pow(std::cos(0.3), 30), 1e-12);
}

// Microfacets between light and eye all face away: only what is scattered is left.
TEST(ReferenceBrdf, NormalTurnedFromTheEye_HasNoHighlightWhereTheHalfVectorIsBehind) {
    Surface s = seenFrom(direction(1.9, 0));
    s.metallic = 1;
    s.roughness = 0.2;
    EXPECT_EQ(reflected(s, kPbr, direction(1.4, 0)), glm::dvec3(0));
    EXPECT_GT(reflected(s, kPbr, direction(1.0, 0)).x, 0);
}

TEST(ReferenceBrdf, LightBehindOrAtGrazingAngles_IsFiniteAndNeverNegative) {
    for (const double angle : {kPi / 2 - 1e-4, kPi / 2 - 1e-7, kPi / 2, kPi / 2 + 1e-7, 2.0, kPi}) {
        for (const double roughness : {0.0, 1.0}) {
            Surface s = seenFrom(direction(angle, 0));
            s.roughness = roughness;
            s.metallic = 0.5;
            const glm::dvec3 out = reflected(s, kPbr, direction(angle, kPi));
            EXPECT_TRUE(std::isfinite(out.x) && out.x >= 0) << angle;
            EXPECT_EQ(reflected(s, kPbr, -s.to_eye).x >= 0, true) << angle;
            EXPECT_GT(out.x, angle < kPi / 2 ? 0 : -1e-300);
        }
    }
}

TEST(ReferenceBrdf, ToonRamp_AtItsPointsAndBetween_IsHermite) {
    settings::ToonRamp ramp{.count = 2, .points = {}};
    ramp.points[0] = {0.25F, 0.5F, 1};
    ramp.points[1] = {0.75F, 1.0F, -1};
    EXPECT_EQ(toonRamp(ramp, 0), 0.5);
    EXPECT_EQ(toonRamp(ramp, 0.25), 0.5);
    EXPECT_EQ(toonRamp(ramp, 0.75), 1);
    EXPECT_EQ(toonRamp(ramp, 9), 1);
    EXPECT_NEAR(toonRamp(ramp, 0.5), 0.75 + 0.5 * (1 + 1) / 8, 1e-15);
    const double h = 1e-6;
    EXPECT_NEAR((toonRamp(ramp, 0.25 + h) - 0.5) / h, 1, 1e-5);
    EXPECT_NEAR((1 - toonRamp(ramp, 0.75 - h)) / h, -1, 1e-5);
}

TEST(ReferenceBrdf, ToonBand_OfAnyLight_IsTheMiddleOfItsBand) {
    for (const uint32_t bands : {1U, 2U, 3U, 8U}) {
        std::set<double> levels;
        for (double light = 1e-6; light < 1e6; light *= 1.01) {
            const double band = toonBand(bands, light, 0.5);
            // The same width on either side, in sqrt(light / (light + middle)).
            const double off = std::sqrt(light / (light + 0.5)) - std::sqrt(band / (band + 0.5));
            EXPECT_LE(std::abs(off), 0.5 / bands + 1e-12) << light;
            levels.insert(band);
        }
        EXPECT_EQ(levels.size(), bands);
        EXPECT_EQ(toonBand(bands, 0, 0.5), 0);
        // Of a share: the same bands, and 1 stays 1.
        levels.clear();
        for (double share = 0.001; share <= 1; share += 0.001) {
            levels.insert(toonBand(bands, share, 0));
        }
        EXPECT_EQ(levels.size(), bands);
        EXPECT_EQ(*levels.rbegin(), 1);
        EXPECT_EQ(toonBand(bands, 0, 0), 0);
    }
    EXPECT_EQ(toonBand(0, 0.3, 0.5), 0.3);
}

TEST(ReferenceBrdf, ToonRim_WhereASurfaceTurnsAway_ScattersMore) {
    const settings::ToonRamp ramp;
    const Model plain{.shading = settings::ShadingModel::kLambert, .ramp = &ramp};
    Model rimmed = plain;
    rimmed.rim = 0.5;
    rimmed.rim_width = 0.25;
    for (const double cosine : {0.24, 0.26}) {
        const Surface s = seenFrom(direction(std::acos(cosine), 0));
        const double ratio = reflected(s, rimmed, s.normal).x / reflected(s, plain, s.normal).x;
        EXPECT_NEAR(ratio, cosine < 0.25 ? 1.5 : 1, 1e-12);
    }
}

} // namespace
} // namespace froxel::reference
