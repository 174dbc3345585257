// Normals in every direction, light that grazes, cut-outs of a pixel, ramps as steep as steps.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::test {

namespace {

using glm::dvec3;
using settings::Renderer;

class HardMaterials : public SharedGpuTest {};

constexpr double kPi = std::numbers::pi;

// The largest angle between a normal and what oct16 stores of it, and what fp32 adds.
constexpr double kOct16Error_rad = 0.0036 * kPi / 180 + 1e-6;

// A rasteriser snaps corners to 1/256 of a pixel, by which an interpolated normal slides: on a
// sphere of this radius by its inverse a pixel, four times that at the rim.
double snapError_rad(double radius_px) {
    return 4 / radius_px * std::numbers::sqrt2 / 512;
}

// How many levels of light a grey picture has, besides black; a level is what fp32 makes of it.
uint32_t levelsOf(const Picture& picture) {
    std::vector<float> all = picture.radiance;
    std::sort(all.begin(), all.end());
    uint32_t count = 0;
    float last = 0;
    for (const float value : all) {
        count += value > last * 1.001F ? 1 : 0;
        last = value;
    }
    return count;
}

// A wall 2 m ahead whose texels are a pixel of the 64 x 36 picture each.
SceneMaker wallOfTexels(const scene::Material& material, const std::vector<std::byte>& rgba8) {
    SceneMaker maker(material);
    const double half_y = std::tan(glm::radians(30.0)) * 2;
    const double half_x = half_y * 64 / 36;
    auto wall = quad({-half_x, -half_y, -2}, {2 * half_x, 0, 0}, {0, 2 * half_y, 0}, 1, 0);
    wall.uv0 = {{0, 1}, {1, 1}, {0, 0}, {1, 0}};
    maker.add(std::move(wall));
    maker.scene.images = {{"texels", 64, 36, rgba8}};
    maker.scene.samplers = {{.mag = scene::Filter::kNearest,
                             .min = scene::Filter::kNearest,
                             .mip = scene::Filter::kNearest,
                             .mipmapped = false}};
    maker.scene.textures = {{0, 0}};
    maker.scene.materials[0].base_color_texture.texture = 0;
    return maker;
}

// An octahedron of flat sides, whose normals nothing interpolates.
scene::Primitive octahedron(float radius_m) {
    scene::Primitive p;
    for (const float x : {-1.0F, 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            for (const float z : {-1.0F, 1.0F}) {
                const auto first = static_cast<uint32_t>(p.positions.size());
                const bool outward = x * y * z > 0;
                const glm::vec3 a(x * radius_m, 0, 0);
                const glm::vec3 b(0, y * radius_m, 0);
                p.positions.insert(p.positions.end(), {a, b, {0, 0, z * radius_m}});
                p.normals.insert(p.normals.end(), 3, glm::normalize(glm::vec3(x, y, z)));
                p.indices.insert(p.indices.end(),
                                 {first, first + (outward ? 1 : 2), first + (outward ? 2 : 1)});
            }
        }
    }
    for (const auto& position : p.positions) {
        p.bounds.add(position);
    }
    return p;
}

// Ahead, without a light.
SceneMaker glossySphere(float roughness) {
    scene::Material gloss = chalk();
    gloss.roughness = roughness;
    SceneMaker maker(gloss);
    glm::dmat4 placed(1);
    placed[3] = glm::dvec4(0, 0, -2.5, 1);
    maker.add(sphere(1, 32, 0), placed);
    return maker;
}

// Of glossySphere() under three suns and a lamp: every renderer is exact, and what the naive one
// draws is finite, not negative and within what is `allowed` of the reference.
template <class Allowed>
void expectAsInDouble(gpu::Device& device, SceneMaker& maker, const Allowed& allowed) {
    maker.sun({0.3, -0.4, -1}).sun({-1, 0.2, -0.1}).sun({0, 0, -1});
    maker.point({2, 1, -1}, 6);
    render::Renderer renderer(device, maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {96, 54};
    inputs.settings.shading = settings::ShadingModel::kPbr;
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    EXPECT_TRUE(std::ranges::all_of(pictures.naive.radiance,
                                    [](float v) { return std::isfinite(v) && v >= 0; }));
    const auto worst = worstOf(pictures.naive, refer(renderer, maker.scene, inputs), allowed);
    EXPECT_LE(worst.ratio, 1) << worst;
}

} // namespace

// Case 24. Spheres show every normal towards the eye: the folds of the octahedron, its corners, its
// centre. Suns have no falloff, so all that the G-buffer can change is the cosine, by the angle.
TEST_F(HardMaterials, NormalsInEveryDirection_AreWithinTheGbuffersBudget) {
    SceneMaker maker;
    glm::dmat4 placed(1);
    for (int i = -1; i <= 1; ++i) {
        placed[3] = glm::dvec4(1.3 * i, 0, -3, 1);
        maker.add(sphere(0.6F, 24, 0), placed);
    }
    maker.sun({0.3, -0.4, -1}).sun({-1, 0.2, -0.1}).sun({0, 0, -1}).sun({0.2, 1, 0.1});
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {160, 90};
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto reference = refer(renderer, maker.scene, inputs);
    const double snap = snapError_rad(15);
    const auto forward = worstOf(pictures.naive, reference, within(0, 4 * snap / kPi));
    EXPECT_LE(forward.ratio, 1) << forward;
    const auto deferred =
        worstOf(pictures.deferred, reference, within(0, 4 * (snap + kOct16Error_rad) / kPi));
    EXPECT_LE(deferred.ratio, 1) << deferred;
}

// The same with highlights from the widest to the sharpest. Either lobe changes by at most 4 /
// roughness^2 of its peak for a radian, and the peak is 1 / (4 pi roughness^4) or less, but for
// Blinn's at roughness 1, 1 / pi; four lights scatter 4 / pi a radian.
TEST_F(HardMaterials, HighlightsOfAnyRoughness_AreAsDoublePrecisionHasThem) {
    for (const float roughness : {0.045F, 0.1F, 0.25F, 0.5F, 1.0F}) {
        SCOPED_TRACE(roughness);
        SceneMaker maker = glossySphere(roughness);
        maker.sun({0.3, -0.4, -1}).sun({-1, 0.2, -0.1}).sun({0, 0, -1});
        maker.point({2, 1, -1}, 6);
        render::Renderer renderer(device(), maker.scene);
        auto inputs = hardInputs();
        inputs.settings.size = {96, 54};
        const auto r = static_cast<double>(roughness);
        const double slope = 4 / (r * r) / (4 * kPi * r * r * r * r) + 4 / kPi;
        const double allowed = snapError_rad(20) * slope;
        for (const auto shading :
             {settings::ShadingModel::kPbr, settings::ShadingModel::kBlinnPhong}) {
            inputs.settings.shading = shading;
            const auto pictures = expectExact(renderer, inputs, Toon::kNo);
            const auto worst = worstOf(pictures.naive, refer(renderer, maker.scene, inputs),
                                       within(1e-4, std::min(allowed, 1.0)));
            EXPECT_LE(worst.ratio, 1) << worst;
        }
    }
}

// Fibres of any roughness and strength, black ones among them: finite, and the double's but for the
// fit of their albedo, snapped corners, and edges where a smooth sheen rises to many times what is
// below it.
TEST_F(HardMaterials, SheenOfAnyRoughness_IsAsDoublePrecisionHasIt) {
    for (const float roughness : {0.0F, 0.2F, 1.0F}) {
        for (const float color : {1.0F, 1e-20F}) {
            if (color < 1 && roughness > 0) {
                continue;
            }
            SCOPED_TRACE(std::to_string(roughness) + " " + std::to_string(color));
            SceneMaker maker = glossySphere(0.5F);
            maker.scene.materials[0].sheen = {.color = glm::vec3(color), .roughness = roughness};
            expectAsInDouble(device(), maker, within(0.01, roughness < 0.2F ? 1 : 0.05));
        }
    }
}

// Highlights as long as they go, from the sharpest to the widest.
TEST_F(HardMaterials, AnisotropyOfAnyRoughness_IsAsDoublePrecisionHasIt) {
    for (const float roughness : {0.0F, 0.3F, 1.0F}) {
        SCOPED_TRACE(roughness);
        SceneMaker maker = glossySphere(roughness);
        maker.scene.materials[0].anisotropy = {.strength = 1, .rotation_rad = 0.6F};
        expectAsInDouble(device(), maker, within(1e-3, roughness == 0 ? 1 : 0.05));
    }
}

// No film, one far beyond what interferes, one of no index, one over what reflects all.
TEST_F(HardMaterials, FilmsOfAnyThickness_AreAsDoublePrecisionHasThem) {
    struct Case {
        float ior;
        float most_nm;
        float base_ior;
    };
    for (const auto& [ior, most_nm, base_ior] :
         {Case{1.3F, 0, 1.5F}, Case{1.3F, 20000, 1.5F}, Case{1, 400, 1.5F}, Case{3, 700, 1},
          Case{1.3F, 0.02F, 0}}) {
        SCOPED_TRACE(std::to_string(ior) + " " + std::to_string(most_nm));
        SceneMaker maker = glossySphere(0.5F);
        maker.scene.materials[0].film = {.strength = 1, .ior = ior, .most_nm = most_nm};
        maker.scene.materials[0].ior = base_ior;
        expectAsInDouble(device(), maker, within(1e-3, 0.05));
    }
}

// None of its own colour left, nothing let through, nearly nothing; bodies that let nothing or all
// through, thicker and thinner than single precision can tell.
TEST_F(HardMaterials, LightFromBehind_IsAsDoublePrecisionHasIt) {
    struct Case {
        float strength;
        glm::vec3 color;
        io::VolumeFactors volume;
    };
    for (const auto& [strength, color, volume] :
         {Case{1, glm::vec3(1), {}}, Case{1, glm::vec3(0), {}}, Case{1e-20F, glm::vec3(1), {}},
          Case{0.7F,
               {1, 0.5F, 0},
               {.attenuation_color = {0, 0.5F, 1}, .attenuation_m = 1e-30F, .thickness_m = 1e30F}},
          Case{0.7F,
               {1, 0.5F, 0},
               {.attenuation_color = {0.01F, 0.5F, 1},
               .attenuation_m = 1e30F,
               .thickness_m = 1e-30F}},
          Case{1,
               glm::vec3(1),
               {.attenuation_color = {0, 0.1F, 1}, .attenuation_m = 10, .thickness_m = 0.2F}}}) {
        SCOPED_TRACE(std::to_string(strength) + " " + std::to_string(volume.thickness_m));
        SceneMaker maker = glossySphere(0.5F);
        maker.sun({0, 0, 1}); // from behind
        maker.scene.materials[0].diffuse_transmission = {.color = color, .strength = strength};
        maker.scene.materials[0].volume = volume;
        expectAsInDouble(device(), maker, within(1e-3, 0.05));
    }
}

// A smaller highlight would slip between pixels.
TEST_F(HardMaterials, RoughnessBelowTheLeast_IsTheLeast) {
    const auto drawn = [&](float roughness) {
        SceneMaker maker = glossySphere(roughness);
        maker.sun({0, 0, -1});
        render::Renderer renderer(device(), maker.scene);
        auto inputs = hardInputs();
        inputs.settings.size = {96, 54};
        inputs.settings.renderer = settings::Renderer::kNaive;
        inputs.settings.shading = settings::ShadingModel::kPbr;
        return draw(renderer, inputs).radiance;
    };
    const auto least = drawn(0.045F);
    EXPECT_TRUE(drawn(0) == least);
    EXPECT_TRUE(drawn(0.044F) == least);
    EXPECT_FALSE(drawn(0.05F) == least);
}

// Case 25. Light along a surface, a hair above it and a hair below.
TEST_F(HardMaterials, GrazingLight_IsNeverNegative) {
    for (const auto shading : {settings::ShadingModel::kLambert,
                               settings::ShadingModel::kBlinnPhong, settings::ShadingModel::kPbr}) {
        for (const double lift : {0.0, 1e-7, -1e-7, 1e-4, -1e-4}) {
            SCOPED_TRACE(lift);
            auto maker = wallAhead(2);
            maker.sun({1, 0, -lift}).sun({0, -1, -lift});
            render::Renderer renderer(device(), maker.scene);
            auto inputs = hardInputs();
            inputs.settings.shading = shading;
            const auto pictures = expectExact(renderer, inputs, Toon::kNo);
            const auto least =
                std::min_element(pictures.naive.radiance.begin(), pictures.naive.radiance.end());
            EXPECT_GE(*least, 0.0F);
            const auto worst =
                worstOf(pictures.naive, refer(renderer, maker.scene, inputs), within(0, 1e-6));
            EXPECT_LE(worst.ratio, 1) << worst;
        }
    }
}

// Case 34. Every other pixel is a hair below the cut-off: prepass, shading and ids must agree.
TEST_F(HardMaterials, CutOutsOfOnePixel_CoverTheSameEverywhere) {
    scene::Material leaves = chalk();
    leaves.alpha_mode = scene::AlphaMode::kMask;
    std::vector<std::byte> texels;
    for (int i = 0; i < 64 * 36; ++i) {
        const bool hole = (i % 64 + i / 64) % 2 == 0;
        const auto alpha = std::byte{static_cast<unsigned char>(hole ? 127 : 128)}; // of 255
        texels.insert(texels.end(), {std::byte{255}, std::byte{255}, std::byte{255}, alpha});
    }
    auto maker = wallOfTexels(leaves, texels);
    maker.point({0, 0, 0}, 0, 100);
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_EQ(litPixels(pictures.naive, 0.1F), 64U * 36U / 2U);
    const auto reference = refer(renderer, maker.scene, inputs);
    for (size_t i = 0; i < reference.visibility.pixels.size(); ++i) {
        const bool hole = (i % 64 + i / 64) % 2 == 0;
        const bool nothing = reference.visibility.pixels[i].instance == VisibleTriangle::kNothing;
        ASSERT_EQ(nothing, hole) << i;
        ASSERT_EQ(pictures.naive.radiance[3 * i] < 0.1F, hole) << i;
        ASSERT_EQ(pictures.deferred.radiance[3 * i] < 0.1F, hole) << i;
    }
}

// Case 39. A ramp that rises within 1e-6 of n.l = 0.5, which crosses the wall as a circle.
TEST_F(HardMaterials, ToonStep_FlipsOnlyAtItsThreshold) {
    auto maker = wallAhead(2);
    maker.point({0.1, 0.05, -1.25}, 0);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {320, 180};
    inputs.settings.toon_fragment = {
        .count = 4, .points = {{{0, 0, 0}, {0.5F, 0, 0}, {0.5F + 1e-6F, 1, 0}, {1, 1, 0}}}};
    inputs.settings.renderer = Renderer::kToonFragment;
    inputs.settings.toon = {.bands = 0, .rim = 0};
    const Picture picture = draw(renderer, inputs);
    const double half_y = std::tan(glm::radians(30.0)) * 2;
    size_t flipped = 0;
    for (uint32_t y = 0; y < 180; ++y) {
        for (uint32_t x = 0; x < 320; ++x) {
            const dvec3 point(((x + 0.5) / 160 - 1) * half_y * 16 / 9,
                              (1 - (y + 0.5) / 90) * half_y, -2);
            const dvec3 to_light = dvec3(0.1, 0.05, -1.25) - point;
            const double cosine = to_light.z / glm::length(to_light);
            const bool lit = at(picture, x, y, 0) > 0;
            if (lit != (cosine > 0.5)) {
                ++flipped;
                EXPECT_NEAR(cosine, 0.5, 1e-5) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(litPixels(picture), 1000U);
    EXPECT_LE(flipped, 320U * 180U / 10'000U);
}

// A floor under one lamp, from above: near it, far from it, and beyond it where nothing arrives.
TEST_F(HardMaterials, ToonBands_OfAFloorUnderOneLamp_AreAsManyAsAsked) {
    auto maker = wallAhead(2);
    maker.point({-1.5, 0, -1.7}, 3, 8);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {320, 180};
    for (const auto kind : {Renderer::kToonFragment, Renderer::kToonCompute}) {
        inputs.settings.renderer = kind;
        for (const auto model : {settings::ShadingModel::kLambert, settings::ShadingModel::kPbr}) {
            inputs.settings.shading = model;
            for (const uint32_t bands : {1U, 2U, 3U, 5U, 8U}) {
                inputs.settings.toon.bands = bands;
                const Picture picture = draw(renderer, inputs);
                EXPECT_EQ(levelsOf(picture), bands)
                    << static_cast<int>(kind) << ' ' << static_cast<int>(model);
            }
        }
    }
}

// Case 40. The norm of black is 0.
TEST_F(HardMaterials, ToonOfBlack_StaysBlack) {
    scene::Material black = chalk();
    black.base_color = {0, 0, 0, 1};
    SceneMaker maker(black);
    maker.add(quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, 1, 0));
    maker.point({0, 0, -1}, 0);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    for (const auto kind : {Renderer::kToonCompute, Renderer::kToonFragment}) {
        inputs.settings.renderer = kind;
        const Picture picture = draw(renderer, inputs);
        EXPECT_EQ(nonFinite(picture), 0U);
        EXPECT_EQ(litPixels(picture), 0U);
    }
}

// Case 44. What nodes squash, stretch and mirror; a normal is off by 1e-5 rad at most.
TEST_F(HardMaterials, MirroredAndStretchedNodes_TurnNormalsRight) {
    SceneMaker maker;
    const dvec3 scales[] = {{1, -1, 3}, {-0.5, 2, 1}, {1, 1, 0.05}, {-1, -1, -1}, {3, 0.3, -0.3}};
    for (int i = 0; i < 5; ++i) {
        glm::dmat4 world(1);
        for (int axis = 0; axis < 3; ++axis) {
            world[axis] *= scales[i][axis];
        }
        const double turn = 0.4 * i; // about y: a rotation behind the scale
        const glm::dmat4 turned(std::cos(turn), 0, -std::sin(turn), 0, 0, 1, 0, 0, std::sin(turn),
                                0, std::cos(turn), 0, (i - 2) * 1.5, 0, -5, 1);
        maker.add(octahedron(0.5F), turned * world);
    }
    maker.sun({0.3, -0.4, -1}).sun({-1, 0.2, -0.1}).sun({0, 0, -1}).sun({0.2, 1, 0.1});
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {160, 90};
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    EXPECT_GT(litPixels(pictures.naive, 0.02F), 300U);
    const auto reference = refer(renderer, maker.scene, inputs);
    const auto worst = worstOf(pictures.naive, reference, within(0, 4e-5 / kPi + 1e-6));
    EXPECT_LE(worst.ratio, 1) << worst;
    const auto deferred =
        worstOf(pictures.deferred, reference, within(0, 4 * (1e-5 + kOct16Error_rad) / kPi + 1e-6));
    EXPECT_LE(deferred.ratio, 1) << deferred;
}

// Case 23. Positions in half precision band near lights 15 m away, which is why they are not the
// default; depth does not.
TEST_F(HardMaterials, HalfPositions_ShowWhatDepthDoesNot) {
    auto maker = wallAhead(15);
    for (int i = -3; i <= 3; ++i) {
        maker.point({i * 2.0, 0.3 * i, -14.93}, 2);
    }
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {160, 90};
    const auto reference = refer(renderer, maker.scene, inputs);
    inputs.settings.renderer = Renderer::kClusteredDeferred;
    // A position in fp32 is off by 4 * 2^-24 of 15 m, 7 cm from a light: 4e-4 in the falloff.
    const auto allowed = within(4e-4, 1e-6);
    const auto depth = worstOf(draw(renderer, inputs), reference, allowed);
    EXPECT_LE(depth.ratio, 1) << depth;
    inputs.settings.gbuffer.position = settings::PositionSource::kFp16;
    EXPECT_GT(worstOf(draw(renderer, inputs), reference, allowed).ratio, 25);
}

} // namespace froxel::test
