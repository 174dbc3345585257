// Rectangular lights, against sums over their parts in double.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <cmath>
#include <map>
#include <string>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardAreas : public SharedGpuTest {};

constexpr double kWall_m = 3;

settings::PlacedLight
rectangle(const dvec3& position, const dvec3& direction, double width_m, double height_m) {
    settings::PlacedLight light;
    light.id = 1;
    light.kind = settings::LightKind::kArea;
    light.position_world = position;
    light.direction_world = direction;
    light.width_m = width_m;
    light.height_m = height_m;
    light.radius_m = 6;
    light.color = {1, 0.5F, 0.25F};
    return light;
}

struct Place {
    std::string name;
    settings::PlacedLight light;
};

// Before a wall across z = -3.
std::vector<Place> places() {
    settings::PlacedLight rolled = rectangle({0.3, 0.1, -2}, {0.2, -0.3, -1}, 1.5, 0.4);
    rolled.roll_deg = 33;
    settings::PlacedLight within = rectangle({0, 0, -2}, {0, 0, -1}, 1, 1);
    within.radius_m = 1.2F;
    return {
        {"facing", rectangle({0, 0, -2}, {0, 0, -1}, 1, 1)},
        {"rolled", rolled},
        {"ends within the picture", within},
        {"sliver", rectangle({0, 0.5, -2.3}, {0, -0.2, -1}, 4, 0.01)},
        {"small", rectangle({0.5, 0, -1}, {0, 0, -1}, 0.02, 0.02)},
        {"large", rectangle({0, 0, -2}, {0, 0, -1}, 6, 5)},
        {"near", rectangle({0, 0, -2.9}, {0, 0, -1}, 0.5, 0.5)},
        {"edge on", rectangle({0.2, 0, -2.6}, {1, 0, 0}, 0.6, 0.6)},
        {"seen from behind", rectangle({0, 0, -2}, {0, 0, 1}, 1, 1)},
        // Through the wall: a part of it is below the surface.
        {"cut by the horizon", rectangle({0, 0, -2.9}, {0.6, 0, -1}, 1, 1)},
        // The centre is behind the wall, a corner before it.
        {"centre below the horizon", rectangle({0, 0, -3.1}, {1, 0.2, -0.3}, 1, 1)},
    };
}

render::FrameInputs litBy(const settings::PlacedLight& light, settings::ShadingModel shading) {
    auto inputs = hardInputs();
    inputs.settings.shading = shading;
    inputs.settings.lights.placed = settings::PlacedLights({light});
    return inputs;
}

SceneMaker wallOf(const scene::Material& material) {
    SceneMaker maker(material);
    maker.add(wallAhead(static_cast<float>(kWall_m)).scene.meshes[0].primitives[0]);
    return maker;
}

struct Difference {
    double worst = 0; // of the brightest wanted
    double rms = 0;   // of the wanted rms
};

Difference differenceTo(const LinearImage& wanted, const Picture& drawn) {
    double brightest = 0;
    double worst = 0;
    double wanted2 = 0;
    double off2 = 0;
    for (size_t i = 0; i < wanted.rgb.size(); ++i) {
        const auto value = static_cast<double>(wanted.rgb[i]);
        const double off = static_cast<double>(drawn.radiance[i]) - value;
        brightest = std::max(brightest, value);
        worst = std::max(worst, std::abs(off));
        wanted2 += value * value;
        off2 += off * off;
    }
    if (brightest == 0) {
        return {worst, std::sqrt(off2)};
    }
    return {worst / brightest, std::sqrt(off2 / wanted2)};
}

} // namespace

// Case 30. What is left is the sum's own coarseness.
TEST_F(HardAreas, Lambert_IsTheSampledIntegral) {
    const auto maker = wallAhead(static_cast<float>(kWall_m));
    render::Renderer renderer(device(), maker.scene);
    for (const auto& place : places()) {
        SCOPED_TRACE(place.name);
        const auto inputs = litBy(place.light, settings::ShadingModel::kLambert);
        const auto pictures = expectExact(renderer, inputs);
        const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture, pictures.naive);
        EXPECT_LT(off.worst, 3e-3);
        const bool behind = place.name == "seen from behind";
        EXPECT_EQ(litPixels(pictures.naive) == 0, behind);
    }
}

// The fit's error: of a microfacet lobe a few hundredths where it shows most, on smooth metal; of
// Blinn's, which falls off faster than any transformed cosine, a tenth, and far from its peak more.
TEST_F(HardAreas, Highlights_AreNearTheSampledIntegral) {
    struct Case {
        float roughness;
        float metallic;
        double most_ggx;
        double most_blinn;
    };
    for (const auto& [roughness, metallic, most_ggx, most_blinn] :
         {Case{1, 0, 0.003, 0.003}, Case{0.5F, 0, 0.005, 0.02}, Case{0.5F, 1, 0.08, 0.2},
          Case{0.25F, 1, 0.06, 0.2}}) {
        auto material = chalk();
        material.roughness = roughness;
        material.metallic = metallic;
        const SceneMaker maker = wallOf(material);
        render::Renderer renderer(device(), maker.scene);
        for (const auto shading :
             {settings::ShadingModel::kPbr, settings::ShadingModel::kBlinnPhong}) {
            const bool ggx = shading == settings::ShadingModel::kPbr;
            for (const auto& place : places()) {
                SCOPED_TRACE(place.name + ", roughness " + std::to_string(roughness) +
                             ", metallic " + std::to_string(metallic) + (ggx ? "" : ", Blinn"));
                auto inputs = litBy(place.light, shading);
                inputs.settings.renderer = settings::Renderer::kNaive;
                const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture,
                                              draw(renderer, inputs));
                const bool off_peak = place.name == "edge on" && roughness < 0.5F;
                EXPECT_LT(off.rms, ggx ? most_ggx : off_peak ? 0.9 : most_blinn);
            }
        }
    }
}

// Rectangles add up what is scattered at edges as other lights do; through fog, too.
TEST_F(HardAreas, DielectricsOfTheirOwn_AreNearTheSampledIntegral) {
    auto material = chalk();
    material.roughness = 0.5F;
    material.ior = 2.4F;
    material.specular = 0.5F;
    material.specular_color = {1, 0.5F, 4};
    const SceneMaker maker = wallOf(material);
    render::Renderer renderer(device(), maker.scene);
    for (const auto& place : places()) {
        SCOPED_TRACE(place.name);
        auto inputs = litBy(place.light, settings::ShadingModel::kPbr);
        const auto pictures = expectExact(renderer, inputs);
        const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture, pictures.naive);
        EXPECT_LT(off.rms, 0.03);
        inputs.settings.fog = {.density = 0.1F, .tile_px = 8};
        (void)expectExact(renderer, inputs);
    }
}

// A coat has a highlight of its own, with a look into the table of its own.
TEST_F(HardAreas, Coats_AreNearTheSampledIntegral) {
    auto material = chalk();
    material.base_color = {0, 0, 0, 1};
    material.specular = 0;
    material.coat.strength = 1;
    material.coat.roughness = 0.5F;
    const SceneMaker maker = wallOf(material);
    render::Renderer renderer(device(), maker.scene);
    for (const auto& place : places()) {
        SCOPED_TRACE(place.name);
        const auto inputs = litBy(place.light, settings::ShadingModel::kPbr);
        const auto pictures = expectExact(renderer, inputs);
        const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture, pictures.naive);
        EXPECT_LT(off.rms, 0.1);
    }
}

// Fibres see a rectangle as nine small lights: coarse where it takes much of what is around.
TEST_F(HardAreas, Sheen_IsNearTheSampledIntegral) {
    auto material = chalk();
    material.base_color = {0, 0, 0, 1};
    material.specular = 0;
    material.sheen = {.color = glm::vec3(1), .roughness = 0.5F};
    const SceneMaker maker = wallOf(material);
    render::Renderer renderer(device(), maker.scene);
    const std::map<std::string, double> coarse = {{"sliver", 0.2},
                                                  {"large", 0.3},
                                                  {"near", 0.15},
                                                  {"cut by the horizon", 0.5},
                                                  {"centre below the horizon", 0.65}};
    for (const auto& place : places()) {
        SCOPED_TRACE(place.name);
        const auto inputs = litBy(place.light, settings::ShadingModel::kPbr);
        const auto pictures = expectExact(renderer, inputs);
        const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture, pictures.naive);
        const auto bound = coarse.find(place.name);
        EXPECT_LT(off.rms, bound != coarse.end() ? bound->second : 0.02);
    }
}

// Highlights longer in one direction are taken for round ones of as much area.
TEST_F(HardAreas, Anisotropy_IsAsFarFromTheSampledIntegralAsItsRoundLobe) {
    auto material = chalk();
    material.roughness = 0.4F;
    material.metallic = 1;
    for (const float strength : {0.3F, 0.8F}) {
        material.anisotropy.strength = strength;
        const SceneMaker maker = wallOf(material);
        render::Renderer renderer(device(), maker.scene);
        for (const auto& place : places()) {
            SCOPED_TRACE(place.name);
            auto inputs = litBy(place.light, settings::ShadingModel::kPbr);
            inputs.settings.renderer = settings::Renderer::kNaive;
            const auto off =
                differenceTo(refer(renderer, maker.scene, inputs).picture, draw(renderer, inputs));
            EXPECT_LT(off.rms, strength < 0.5F ? 0.25 : 0.65);
        }
    }
}

// Many, with points and spots among them, each ending somewhere in the picture.
TEST_F(HardAreas, AmongOthers_ListsAreExact) {
    auto material = chalk();
    material.roughness = 0.4F;
    const SceneMaker maker = wallOf(material);
    auto inputs = hardInputs();
    std::vector<settings::PlacedLight> placed;
    for (uint32_t i = 0; i < 40; ++i) {
        const double turn = 0.7 * i;
        auto light = rectangle({0.12 * i - 2.4, std::sin(turn), -3.2 + 0.05 * i},
                               {std::sin(turn), 0.3, std::cos(turn)}, 0.1 + 0.02 * i, 0.3);
        light.id = i + 1;
        light.kind = static_cast<settings::LightKind>(i % 3);
        light.radius_m = 0.5F + 0.02F * static_cast<float>(i);
        placed.push_back(light);
    }
    inputs.settings.lights.placed = settings::PlacedLights(placed);
    render::Renderer renderer(device(), maker.scene);
    for (const auto shading : {settings::ShadingModel::kLambert, settings::ShadingModel::kPbr,
                               settings::ShadingModel::kBlinnPhong}) {
        SCOPED_TRACE(static_cast<int>(shading));
        inputs.settings.shading = shading;
        EXPECT_GT(litPixels(expectExact(renderer, inputs).naive), 500U);
    }
}

// Rectangles and spots in the places of seeded lights and of the scene's, before and behind others.
TEST_F(HardAreas, InOthersPlaces_ListsAreExact) {
    SceneMaker maker = wallAhead(static_cast<float>(kWall_m));
    maker.point({0.5, 0.4, -2.5}, 2).point({-0.5, 0.4, -2.5}, 2);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 9;
    inputs.settings.lights.box = BoundsD3{{-2, -1, -3.4}, {2, 1, -2}};
    inputs.settings.shading = settings::ShadingModel::kLambert;
    using Of = settings::LightRef::Of;
    std::vector<settings::PlacedLight> placed;
    for (const settings::LightRef& replaced :
         {settings::LightRef{Of::kSeed, 6}, settings::LightRef{Of::kSeed, 2},
          settings::LightRef{Of::kScene, 0}}) {
        const auto i = static_cast<double>(placed.size());
        auto light = rectangle({i - 1, 0.3 * i, -2.2}, {0.2, 0.1 * i, -1}, 0.6, 0.4);
        light.id = static_cast<uint32_t>(placed.size()) + 1;
        light.kind = placed.size() == 2 ? settings::LightKind::kSpot : settings::LightKind::kArea;
        light.radius_m = 3;
        light.replaces = replaced;
        placed.push_back(light);
    }
    render::Renderer renderer(device(), maker.scene);
    const auto before = expectExact(renderer, inputs);
    inputs.settings.lights.placed = settings::PlacedLights(placed);
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(differingFloats(pictures.naive, before.naive), 500U);
}

// A rectangle far smaller than its distance is the spot that shines ahead of it.
TEST_F(HardAreas, FromAfar_IsThePointsLight) {
    const auto maker = wallAhead(static_cast<float>(kWall_m));
    render::Renderer renderer(device(), maker.scene);
    const auto area = rectangle({0.4, 0.2, -0.5}, {0, 0, -1}, 0.01, 0.01);
    auto point = area;
    point.kind = settings::LightKind::kPoint;
    const auto drawn = expectExact(renderer, litBy(area, settings::ShadingModel::kLambert)).naive;
    const auto wanted = expectExact(renderer, litBy(point, settings::ShadingModel::kLambert)).naive;
    const double half = std::tan(glm::radians(30.0)) * kWall_m;
    for (uint32_t y = 0; y < 36; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            const dvec3 at{((x + 0.5) / 32 - 1) * half * 64 / 36, (1 - (y + 0.5) / 18) * half,
                           -kWall_m};
            const dvec3 away = at - area.position_world;
            const double cosine = -away.z / glm::length(away); // of the sender: a point has none
            const size_t i = 3 * (size_t{64} * y + x);
            const double as_point = static_cast<double>(wanted.radiance[i]) * cosine;
            EXPECT_NEAR(static_cast<double>(drawn.radiance[i]), as_point, 2e-4 * as_point);
        }
    }
}

TEST_F(HardAreas, InAMedium_ScattersAsSampled) {
    const auto maker = wallAhead(static_cast<float>(kWall_m));
    render::Renderer renderer(device(), maker.scene);
    auto inputs =
        litBy(rectangle({0.3, 0, -1.8}, {0, 0, -1}, 0.8, 0.5), settings::ShadingModel::kLambert);
    inputs.settings.fog.density = 0.2F;
    inputs.settings.fog.tile_px = 4;
    inputs.settings.fog.slice_count = 256;
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto off = differenceTo(refer(renderer, maker.scene, inputs).picture, pictures.naive);
    EXPECT_LT(off.rms, 0.03);
}

} // namespace froxel::test
