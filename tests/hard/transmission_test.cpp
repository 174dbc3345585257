// Glass at the ends of what its numbers may be: nothing is bent, nothing passes, everything is
// blurred, the eye is inside.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"

#include <algorithm>
#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardTransmission : public SharedGpuTest {};

// Reflects nothing, at no angle.
scene::Material clearGlass() {
    scene::Material material = chalk();
    material.roughness = 0;
    material.specular = 0;
    material.transmission.strength = 1;
    return material;
}

render::FrameInputs glassInputs() {
    auto inputs = hardInputs();
    inputs.settings.shading = settings::ShadingModel::kPbr;
    inputs.settings.lights.ambient = 1;
    return inputs;
}

// A wall of one colour, 6 m ahead, that fills the view.
SceneMaker before(const glm::vec3& color) {
    scene::Material wall = chalk();
    wall.base_color = glm::vec4(color, 1);
    SceneMaker maker(wall);
    maker.add(quad({-20, -20, -6}, {40, 0, 0}, {0, 40, 0}, 1, 0));
    return maker;
}

SceneMaker paneBefore(const glm::vec3& color, const scene::Material& material) {
    SceneMaker maker = before(color);
    maker.add(quad({-0.6F, -0.4F, -2}, {1.2F, 0, 0}, {0, 0.8F, 0}, 1, maker.add(material)));
    return maker;
}

// Halves of different colours, whose border is at x = 0 from the eye.
SceneMaker halves() {
    SceneMaker maker = before({0.8F, 0.5F, 0.2F});
    scene::Material other = chalk();
    other.base_color = {0.1F, 0.3F, 0.6F, 1};
    maker.add(quad({0, -20, -5.9F}, {20, 0, 0}, {0, 40, 0}, 1, maker.add(other)));
    return maker;
}

void expectColor(const dvec3& color, const dvec3& expected, double error) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(color[c], expected[c], error) << "channel " << c;
    }
}

constexpr uint32_t kMiddleX = 32;
constexpr uint32_t kMiddleY = 18;

// Also where compute finds layers and shades them. Strong dispersion looks up pixels apart by what
// depths of both ways are: 0.3 %.
ExactPictures drawn(gpu::Device& device, const SceneMaker& maker, Toon toon = Toon::kToo) {
    render::Renderer renderer(device, maker.scene);
    const ExactPictures pictures = expectExact(renderer, glassInputs(), toon);
    const Picture by_ids = drawByPlanes(renderer, glassInputs());
    EXPECT_EQ(nonFinite(by_ids), 0U);
    const dvec3 drawn = colorAt(pictures.naive, kMiddleX, kMiddleY);
    expectColor(colorAt(by_ids, kMiddleX, kMiddleY), drawn,
                0.01 * std::max({drawn.x, drawn.y, drawn.z, 1.0}));
    return pictures;
}

} // namespace

TEST_F(HardTransmission, NoThickness_BendsNothingWhateverTheIndex) {
    const auto bare = drawn(device(), halves()).naive;
    for (const float ior : {1.0F, 1.5F, 2.4F, 100.0F}) {
        SCOPED_TRACE(ior);
        SceneMaker maker = halves();
        scene::Material material = clearGlass();
        material.ior = ior;
        maker.add(quad({-0.6F, -0.4F, -2}, {1.2F, 0, 0}, {0, 0.8F, 0}, 1, maker.add(material)));
        EXPECT_EQ(differingFloats(drawn(device(), maker).naive, bare), 0U);
    }
}

TEST_F(HardTransmission, IndexOfOne_NeitherBendsNorBlurs) {
    const auto bare = drawn(device(), halves()).naive;
    scene::Material material = clearGlass();
    material.ior = 1;
    material.roughness = 1;
    material.volume.thickness_m = 0.5F;
    SceneMaker maker = halves();
    maker.add(quad({-0.6F, -0.4F, -2}, {1.2F, 0, 0}, {0, 0.8F, 0}, 1, maker.add(material)));
    const auto seen = drawn(device(), maker).naive;
    for (uint32_t x = 24; x < 40; ++x) { // looked up at the pixel's centre, within rounding
        expectColor(colorAt(seen, x, kMiddleY), colorAt(bare, x, kMiddleY), 1e-3);
    }
}

// An index without end: all is reflected.
TEST_F(HardTransmission, IndexOfZero_LetsNothingPass) {
    scene::Material material = clearGlass();
    material.ior = 0;
    material.specular = 1;
    material.base_color = {0, 0, 0, 1};
    const dvec3 black =
        colorAt(drawn(device(), paneBefore({1, 0, 0}, material)).naive, kMiddleX, kMiddleY);
    material.base_color = {1, 1, 1, 1};
    const dvec3 white =
        colorAt(drawn(device(), paneBefore({1, 0, 0}, material)).naive, kMiddleX, kMiddleY);
    expectColor(white, black, 1e-6);
}

TEST_F(HardTransmission, Attenuation_AtItsEnds_IsAllOrNothing) {
    const dvec3 wall =
        colorAt(drawn(device(), before({0.8F, 0.6F, 0.4F})).naive, kMiddleX, kMiddleY);
    struct Case {
        glm::vec3 color;
        float distance_m;
        float thickness_m;
        dvec3 left;
    };
    const double half = std::exp2(-0.5);
    const float beyond = std::numeric_limits<float>::max();
    for (const Case& it : {Case{{0.5F, 1, 0}, 0, 0.1F, {1, 1, 1}},            // no end
                           Case{{0.5F, 0.5F, 0.5F}, beyond, 0.1F, {1, 1, 1}}, // too far away
                           Case{{1, 1, 1}, 1e-6F, 1, {1, 1, 1}},              // white
                           Case{{0, 0, 0}, 1, 0.1F, {0, 0, 0}},               // black
                           Case{{0, 0, 0}, 1, 0, {1, 1, 1}},                  // no body
                           Case{{0.5F, 0.5F, 1}, 1e-6F, 1, {0, 0, 1}},
                           Case{{0.5F, 0.5F, 1}, 0.2F, 0.1F, {half, half, 1}}}) {
        scene::Material material = clearGlass();
        material.ior = 1;
        material.volume = {.attenuation_color = it.color,
                           .attenuation_m = it.distance_m,
                           .thickness_m = it.thickness_m};
        const auto seen = drawn(device(), paneBefore({0.8F, 0.6F, 0.4F}, material)).naive;
        // Half a pixel beside the axis, where the way is as good as straight.
        expectColor(colorAt(seen, kMiddleX, kMiddleY), wall * it.left, 1e-3);
    }
}

TEST_F(HardTransmission, RoughnessOfOne_BeforeOneColour_IsThatColour) {
    const dvec3 wall =
        colorAt(drawn(device(), before({0.8F, 0.6F, 0.4F})).naive, kMiddleX, kMiddleY);
    for (const float roughness : {0.0F, 1e-6F, 0.5F, 1.0F}) {
        scene::Material material = clearGlass();
        material.roughness = roughness;
        const auto seen = drawn(device(), paneBefore({0.8F, 0.6F, 0.4F}, material)).naive;
        expectColor(colorAt(seen, kMiddleX, kMiddleY), wall, 1e-5);
    }
}

// The front faces of what is around the eye look away from it. Of both sides the near one is seen,
// through which the rest is.
TEST_F(HardTransmission, EyeInsideOfGlass_SeesThroughIt) {
    const auto bare = drawn(device(), halves()).naive;
    scene::Material material = clearGlass();
    material.volume = {
        .attenuation_color = {0.5F, 0.5F, 0.5F}, .attenuation_m = 1, .thickness_m = 1};
    SceneMaker one_sided = halves();
    one_sided.add(sphere(1, 16, one_sided.add(material)));
    EXPECT_EQ(differingFloats(drawn(device(), one_sided).naive, bare), 0U);
    material.double_sided = true;
    SceneMaker both = halves();
    both.add(sphere(1, 16, both.add(material)));
    const auto seen = drawn(device(), both).naive;
    // Halfway to the left, where a metre of glass is between eye and wall.
    expectColor(colorAt(seen, 16, kMiddleY), colorAt(bare, 16, kMiddleY) * 0.5, 0.02);
}

// The way through the fog is as long as without the pane.
TEST_F(HardTransmission, ClearPaneInFog_ChangesNothing) {
    const auto fogged = [&](const SceneMaker& maker) {
        render::Renderer renderer(device(), maker.scene);
        auto inputs = glassInputs();
        inputs.settings.fog.density = 0.3F;
        return expectExact(renderer, inputs).naive;
    };
    const Picture bare = fogged(before({0.8F, 0.6F, 0.4F}));
    const Picture seen = fogged(paneBefore({0.8F, 0.6F, 0.4F}, clearGlass()));
    for (size_t i = 0; i < bare.radiance.size(); ++i) {
        ASSERT_NEAR(seen.radiance[i], bare.radiance[i], 1e-5F * (1 + bare.radiance[i]));
    }
}

// From the middle of a ball to its rim, where nothing enters and what does leaves at once; colours
// that are bent as far as numbers go; surfaces seen edge on.
TEST_F(HardTransmission, RimsAndStrongDispersion_AreFinite) {
    struct Case {
        float dispersion;
        float roughness;
    };
    for (const auto& [dispersion, roughness] : {Case{0, 0}, Case{1, 0}, Case{1e6F, 1}}) {
        scene::Material material = clearGlass();
        material.specular = 1;
        material.ior = 2.4F;
        material.roughness = roughness;
        material.double_sided = true;
        material.transmission.dispersion = dispersion;
        material.volume.thickness_m = 1e6F;
        SceneMaker maker = halves();
        const uint32_t glass = maker.add(material);
        glm::dmat4 place(1);
        place[3] = {0.3, 0.2, -3, 1};
        maker.add(sphere(1, 12, glass), place);
        maker.add(quad({-1, 0, -4}, {2, 0, 0}, {0, 0, 3}, 1, glass)); // edge on
        maker.point({0, 1, -5}, 9, 3).point({0, 0, -3}, 9, 3);
        EXPECT_GT(litPixels(drawn(device(), maker, Toon::kNo).naive), 2000U);
    }
}

// Thickness is in the mesh's own space: a node's scale counts, mirrored or not. A flat node has
// none.
TEST_F(HardTransmission, ScaledAndMirroredNodes_AreAsThickAsTheyAre) {
    const auto seenAt = [&](const glm::dvec3& scale, float thickness_m) {
        scene::Material material = clearGlass();
        material.ior = 1.5F;
        material.volume.thickness_m = thickness_m;
        SceneMaker maker = halves();
        glm::dmat4 place(1);
        place[0].x = scale.x;
        place[1].y = scale.y;
        place[2].z = scale.z;
        place[3] = {0.4, 0, -2, 1};
        auto pane = quad({-0.5F / static_cast<float>(std::abs(scale.x)), -0.4F, 0},
                         {1 / std::abs(scale.x), 0, 0}, {0, 0.8, 0}, 1, maker.add(material));
        maker.add(std::move(pane), place);
        return drawn(device(), maker).naive;
    };
    const Picture plain = seenAt({1, 1, 1}, 0.8F);
    EXPECT_EQ(differingFloats(seenAt({-1, 1, 1}, 0.8F), plain), 0U);
    const Picture larger = seenAt({2, 1, 2}, 0.4F);
    for (size_t i = 0; i < plain.radiance.size(); ++i) {
        ASSERT_NEAR(larger.radiance[i], plain.radiance[i], 0.02F);
    }
    const Picture flat = seenAt({1, 1, 0}, 0.8F);
    EXPECT_EQ(nonFinite(flat), 0U);
}

} // namespace froxel::test
