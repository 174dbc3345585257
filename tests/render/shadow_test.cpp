// Shadow maps on pictures: no acne, no leaks, no shimmer, exact lists, and the double-precision
// reference's rays.
#include "interface/constants.h"
#include "reference/shade.h"
#include "render/scene/scene_resources.h"
#include "render/steps/shadows.h"
#include "render/view/visibility_readback.h"
#include "support/draw.h"
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace froxel::test {

namespace {

using glm::dvec3;
using settings::Renderer;

class Shadows : public SharedGpuTest {};

render::FrameInputs
inputsFrom(const dvec3& eye, const dvec3& target, const settings::Shadows& shadows) {
    auto inputs = hardInputs();
    inputs.settings.size = {96, 54};
    inputs.settings.renderer = Renderer::kForwardPlus;
    inputs.settings.camera = settings::lookAt(eye, target, {0, 1, 0});
    inputs.settings.camera.yfov_rad = glm::radians(60.0);
    inputs.settings.shadows = shadows;
    return inputs;
}

// A floor of 20 m with its middle at the origin.
scene::Primitive ground(uint32_t cells, uint32_t material = 0) {
    return quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}, cells, material);
}

Picture drawn(const scene::Scene& scene, const render::FrameInputs& inputs, gpu::Device& device) {
    render::Renderer renderer(device, scene);
    return draw(renderer, inputs);
}

// The picture's luminance at a point of the world.
float lightAt(const Picture& picture, const settings::ViewSettings& settings, const dvec3& world) {
    const auto& camera = settings.camera;
    const dvec3 seen = glm::transpose(camera.world_from_view) * (world - camera.eye_world);
    const double half = std::tan(camera.yfov_rad * 0.5) * -seen.z;
    const double aspect = static_cast<double>(picture.width_px) / picture.height_px;
    const auto x = static_cast<uint32_t>((seen.x / (half * aspect) + 1) * 0.5 * picture.width_px);
    const auto y = static_cast<uint32_t>((1 - seen.y / half) * 0.5 * picture.height_px);
    return at(picture, x, y, 0);
}

} // namespace

// Alone in the scene a plane can only be in its own shadow: with maps it looks as without, bit for
// bit, at every angle of the light and every place of the picture, grazing light too.
TEST_F(Shadows, APlane_HasNoAcneAtAnyAngle) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    const int angles = wholeGrids() ? 24 : 9;
    size_t lit = 0;
    for (int i = 0; i < angles; ++i) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 4 * unit(random),
                                            glm::normalize(dvec3(unit(random), unit(random), 1)));
        const auto placed = [&](double x, double y, double z) {
            return dvec3(turn * glm::dvec4(x, y, z, 1));
        };
        SceneMaker maker;
        maker.add(ground(1 + static_cast<uint32_t>(i)), turn);
        const double height = i % 3 == 0 ? 0.02 : i % 3 == 1 ? 0.5 : 4.0;
        maker.point(placed(2 * unit(random), height, 2 * unit(random)), 15, 10);
        maker.spot(placed(-3, height, 0), placed(1, -0.3, 0) - placed(0, 0, 0), 15, 20, 50);
        auto inputs = inputsFrom(placed(0, 4, 7), placed(0, 0, 0), {2, 0});
        render::Renderer renderer(device(), maker.scene);
        render::ViewRenderer view(renderer);
        for (const uint32_t size_px : {64U, 177U, 512U}) {
            inputs.settings.shadows = {2, size_px};
            const Picture with = draw(view, inputs);
            inputs.settings.shadows = {};
            EXPECT_EQ(differingFloats(with, draw(view, inputs)), 0U)
                << "angle " << i << ", size " << size_px;
            EXPECT_EQ(with.stats.steps.count("shadows", "lights"), 2U);
            lit += litPixels(with);
        }
    }
    EXPECT_GT(lit, static_cast<size_t>(angles) * 100'000 / 24);
}

// Walls without thickness all around the light, drawn from either side: nothing gets out, also at
// corners and where a wall stands on the floor that goes on outside.
TEST_F(Shadows, AClosedBox_LetsNothingOut) {
    for (const bool outwards : {false, true}) {
        SceneMaker maker;
        maker.add(ground(8));
        scene::Scene box = insideOfABox(0.5F).scene;
        for (auto& mesh : box.meshes) {
            auto& part = mesh.primitives.front();
            for (size_t i = 0; outwards && i < part.indices.size(); i += 3) {
                std::swap(part.indices[i], part.indices[i + 1]);
            }
            for (auto& normal : part.normals) {
                normal *= outwards ? -1.0F : 1.0F;
            }
            maker.add(part, glm::translate(glm::dmat4(1), dvec3(0.3, 0.5, -0.2)));
        }
        maker.point({0.4, 0.45, -0.1}, 8, 10);
        render::Renderer renderer(device(), maker.scene);
        render::ViewRenderer view(renderer);
        for (const uint32_t size_px : {64U, 256U}) {
            auto inputs = inputsFrom({2, 3, 4}, {0, 0.5, 0}, {1, size_px});
            const Picture with = draw(view, inputs);
            if (outwards) {
                auto unlit = inputs;
                unlit.settings.lights.scene_lights = false;
                EXPECT_EQ(differingFloats(with, draw(view, unlit)), 0U) << size_px;
            } // else the inside shows through the walls' culled backs: look at the floor alone
            for (const dvec3& outside : {dvec3(0.9, 0, -0.2), dvec3(0.82, 0, 0.32),
                                         dvec3(0.3, 0, 0.4), dvec3(-2, 0, 1), dvec3(3, 0, -3)}) {
                EXPECT_EQ(lightAt(with, inputs.settings, outside), 0)
                    << outside.x << " " << outside.z << " " << size_px;
            }
            inputs.settings.shadows = {};
            EXPECT_GT(lightAt(draw(view, inputs), inputs.settings, {0.9, 0, -0.2}), 0);
        }
    }
}

namespace {

// The bits of an atlas's first tiles, which lie in its first row; what no light uses is undefined.
std::vector<uint32_t> bitsOfTiles(const render::ShadowAtlas& atlas, uint32_t tile_count) {
    std::vector<uint32_t> bits;
    for (size_t y = 0; y < atlas.size_px; ++y) {
        for (size_t x = 0; x < size_t{tile_count} * atlas.size_px; ++x) {
            bits.push_back(std::bit_cast<uint32_t>(atlas.depths[y * atlas.width_px + x]));
        }
    }
    return bits;
}

} // namespace

// Depths of a light's maps are the same bits wherever the camera stands, so that shadows do not
// shimmer; and not those of a light that has moved.
TEST_F(Shadows, ACameraThatMoves_LeavesTexelsAsTheyAre) {
    auto room = makeRoom();
    scene::PunctualLight lamp;
    lamp.position_world = {0.3, 2.7, 1.1};
    lamp.range_m = 6;
    lamp.intensity = 5;
    room.lights = {lamp};
    scene::PunctualLight spot = lamp;
    spot.type = scene::LightType::kSpot;
    spot.direction_world = glm::normalize(dvec3(-0.3, -1, -0.4));
    spot.outer_cone_rad = 0.7;
    room.lights.push_back(spot);
    const auto mapsFrom = [&](render::Renderer& renderer, const dvec3& eye) {
        auto inputs = inputsFrom(eye, {0, 1, 0}, {3, 128});
        inputs.settings.lights.count = 1;
        inputs.settings.lights.radius_m = 4;
        inputs.time_s = 3;
        render::ViewRenderer view(renderer);
        (void)draw(view, inputs);
        return render::copyShadows(view.steps());
    };
    render::Renderer renderer(device(), room);
    const auto first = mapsFrom(renderer, {0.5, 2.2, 7});
    ASSERT_EQ(first.first_tiles.size(), 3U);
    const auto bits = bitsOfTiles(first, 13); // two point lights and a spot
    EXPECT_GT(std::count_if(bits.begin(), bits.end(), [](uint32_t b) { return b != 0; }), 10'000);
    for (const dvec3& eye : {dvec3(0.5001, 2.2, 7), dvec3(-5, 0.4, 3), dvec3(0, 9, 0.5)}) {
        const auto moved = mapsFrom(renderer, eye);
        EXPECT_EQ(moved.shadow_of_light, first.shadow_of_light);
        EXPECT_TRUE(bitsOfTiles(moved, 13) == bits);
    }
    room.lights[0].position_world.x += 0.01;
    render::Renderer other(device(), room);
    EXPECT_FALSE(bitsOfTiles(mapsFrom(other, {0.5, 2.2, 7}), 13) == bits);
}

// The exactness contract with shadows, by every way to add lights up.
TEST_F(Shadows, ListsStagesAndLoops_AreExact) {
    auto room = makeRoom();
    scene::PunctualLight spot;
    spot.type = scene::LightType::kSpot;
    spot.position_world = {1, 4, 2};
    spot.direction_world = glm::normalize(dvec3(0, -1, -0.2));
    spot.intensity = 20;
    room.lights = {spot};
    render::Renderer renderer(device(), room);
    render::ViewRenderer view(renderer);
    for (const auto& camera : room.cameras) {
        for (const auto shading :
             {settings::ShadingModel::kPbr, settings::ShadingModel::kLambert}) {
            const bool first = &camera == &room.cameras.front();
            if (!wholeGrids() && first != (shading == settings::ShadingModel::kPbr)) {
                continue;
            }
            auto inputs = inputsFrom({0, 0, 0}, {0, 0, -1}, {20, 96});
            inputs.settings.camera = camera.camera;
            inputs.settings.shading = shading;
            inputs.settings.lights.count = 150;
            inputs.settings.lights.radius_m = 3;
            inputs.time_s = 2;
            (void)expectExact(view, inputs);
            for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
                SCOPED_TRACE(settings::kRendererNames[kind]);
                inputs.settings.renderer = static_cast<Renderer>(kind);
                const Picture usual = draw(view, inputs);
                EXPECT_EQ(usual.stats.steps.count("shadows", "lights"), 20U);
                EXPECT_EQ(differingFloats(usual, draw(view, inputs)), 0U);
                for (const auto part : {render::GenericParts{.plain_loops = true},
                                        render::GenericParts{.uncut_loops = true},
                                        render::GenericParts{.uneven_radii = true}}) {
                    auto generic = inputs;
                    generic.generic = part;
                    EXPECT_EQ(differingFloats(usual, draw(view, generic)), 0U);
                }
                if (!render::isForward(inputs.settings.renderer)) {
                    auto fragment = inputs;
                    fragment.settings.lighting = settings::LightingStage::kFragment;
                    EXPECT_EQ(differingFloats(usual, draw(view, fragment)), 0U);
                }
            }
        }
    }
}

// Without maps nothing of them exists, and a light out of view changes no bit.
TEST_F(Shadows, WhereNoneAreAskedForOrSeen_NothingIsThere) {
    const auto room = makeRoom();
    render::Renderer renderer(device(), room);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFrom({0.5, 2.2, 7}, {0, 1, 0}, {});
    inputs.settings.lights.count = 40;
    const Picture without = draw(view, inputs);
    EXPECT_EQ(device().memoryLedger()->byPurpose().count("shadow atlas"), 0U);
    for (const auto& made : renderer.resources().shared.pipelines.made()) {
        EXPECT_EQ(made.key.light_flags & io::kLightShadows, 0U);
    }
    EXPECT_EQ(without.stats.steps.count("shadows", "maps"), 0U);
    EXPECT_FALSE(hasPass(without, "shadows"));
    inputs.settings.shadows = {32, 128};
    const Picture with = draw(view, inputs);
    EXPECT_EQ(with.stats.steps.count("shadows", "lights"), 32U);
    EXPECT_EQ(with.stats.steps.count("shadows", "maps"), 192U);
    EXPECT_GT(with.stats.steps.count("shadows", "triangles"), 0U);
    EXPECT_TRUE(hasPass(with, "shadows"));
    EXPECT_GT(differingFloats(without, with), 0U);
    EXPECT_GE(device().memoryLedger()->byPurpose().at("shadow atlas"), 192U * 128 * 128 * 4);
    inputs.settings.shadows = {};
    EXPECT_EQ(differingFloats(without, draw(view, inputs)), 0U);
    // Each slot lets go of its maps as it is used again.
    for (int i = 0; i < 3; ++i) {
        (void)draw(view, inputs);
    }
    EXPECT_EQ(device().memoryLedger()->byPurpose().count("shadow atlas"), 0U);

    inputs.settings.lights.box = BoundsD3{{-50, 50, -50}, {-40, 60, -40}};
    const Picture dark = draw(view, inputs);
    inputs.settings.shadows = {4, 128};
    const Picture unseen = draw(view, inputs);
    EXPECT_EQ(unseen.stats.steps.count("shadows", "lights"), 0U);
    EXPECT_EQ(differingFloats(dark, unseen), 0U);
}

// What casts: solid and cut-out surfaces from both sides, not glass and not what glows.
TEST_F(Shadows, Casters_AreSolidOrCutOut) {
    enum class Kind { kSolid, kBack, kGlass, kGlowing, kCutOut, kUncut };
    for (const auto kind :
         {Kind::kSolid, Kind::kBack, Kind::kGlass, Kind::kGlowing, Kind::kCutOut, Kind::kUncut}) {
        SceneMaker maker;
        scene::Material pane = chalk();
        pane.alpha_mode = kind == Kind::kGlass ? scene::AlphaMode::kBlend
                          : kind == Kind::kCutOut || kind == Kind::kUncut
                              ? scene::AlphaMode::kMask
                              : scene::AlphaMode::kOpaque;
        pane.base_color.w = kind == Kind::kCutOut ? 0.4F : kind == Kind::kGlass ? 0.5F : 0.6F;
        pane.emissive = glm::vec3(kind == Kind::kGlowing ? 1.0F : 0.0F);
        const uint32_t material = maker.add(pane);
        maker.add(ground(4));
        maker.add(kind == Kind::kBack ? quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 2, material)
                                      : quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, 2, material));
        maker.point({0, 2, 0}, 12, 10);
        const auto inputs = inputsFrom({0, 3, 7}, {0, 0, 0}, {1, 256});
        const Picture picture = drawn(maker.scene, inputs, device());
        const bool casts = kind == Kind::kSolid || kind == Kind::kBack || kind == Kind::kUncut;
        EXPECT_EQ(lightAt(picture, inputs.settings, {1.4, 0, 1.4}) == 0, casts)
            << static_cast<int>(kind);
        EXPECT_GT(lightAt(picture, inputs.settings, {2.6, 0, 2.2}), 0); // beyond the shadow
    }
}

namespace {

// The room without textures and glass.
scene::Scene plainRoom() {
    scene::Scene room = makeRoom();
    for (auto& material : room.materials) {
        material = chalk();
    }
    room.instances.erase(room.instances.begin() + 3);
    return room;
}

// What a pixel shows: instance and primitive, which are flat there.
std::pair<uint32_t, uint32_t> surfaceOf(const Visibility& seen, size_t pixel) {
    return {seen.pixels[pixel].instance, seen.pixels[pixel].primitive};
}

// Whether something holds for a pixel around one of 240 x 135.
template <class Holds>
bool anyNear(int x, int y, Holds holds) {
    constexpr int kNear_px = 4;
    bool any = false;
    for (int ny = std::max(y - kNear_px, 0); ny <= std::min(y + kNear_px, 134); ++ny) {
        for (int nx = std::max(x - kNear_px, 0); nx <= std::min(x + kNear_px, 239); ++nx) {
            any = any || holds(static_cast<size_t>(ny * 240 + nx));
        }
    }
    return any;
}

} // namespace

// Of a pane of this material between a lamp and the ground, as a share of what arrives without one:
// at a point of the ground.
namespace {

float shareBehind(gpu::Device& device, const scene::Material& material, const dvec3& point) {
    SceneMaker bare;
    bare.add(ground(8)).point({0, 4, 0}, 20, 8);
    SceneMaker glazed;
    glazed.add(ground(8)).point({0, 4, 0}, 20, 8);
    glazed.add(quad({-1, 2, 1}, {2, 0, 0}, {0, 0, -2}, 1, glazed.add(material)));
    const auto inputs = inputsFrom({0, 1.5, 9}, {0, 0, 0}, {1, 512});
    return lightAt(drawn(glazed.scene, inputs, device), inputs.settings, point) /
           lightAt(drawn(bare.scene, inputs, device), inputs.settings, point);
}

} // namespace

// A map has fifteen levels of light, so a share is within half of one.
TEST_F(Shadows, SurfacesThatTransmitLight_DimIt) {
    constexpr float kHalfLevel = 0.5F / 15 + 0.002F;
    const dvec3 behind(0.3, 0, 0.4);
    const dvec3 beside(3.2, 0, 0);
    scene::Material glass = chalk();
    glass.transmission.strength = 1;
    EXPECT_NEAR(shareBehind(device(), glass, behind), 1, kHalfLevel);
    glass.transmission.strength = 0.6F;
    EXPECT_NEAR(shareBehind(device(), glass, behind), 0.6F, kHalfLevel);
    EXPECT_FLOAT_EQ(shareBehind(device(), glass, beside), 1);
    glass.base_color = {0.2F, 0.2F, 0.2F, 1};
    EXPECT_NEAR(shareBehind(device(), glass, behind), 0.12F, kHalfLevel);
    glass.base_color = {1, 1, 1, 0.5F}; // half of it is not there
    glass.alpha_mode = scene::AlphaMode::kBlend;
    EXPECT_NEAR(shareBehind(device(), glass, behind), 0.8F, kHalfLevel);
    glass.alpha_mode = scene::AlphaMode::kOpaque;
    glass.transmission.strength = 1;
    glass.volume = {.attenuation_color = {0.25F, 0.25F, 0.25F}, // one of two sides
                    .attenuation_m = 0.1F,
                    .thickness_m = 0.1F};
    EXPECT_NEAR(shareBehind(device(), glass, behind), 0.5F, kHalfLevel);
    glass.metallic = 1;
    EXPECT_NEAR(shareBehind(device(), glass, behind), 0, kHalfLevel);
}

// As rays have it where no edge is near, before and behind the glass, and after a turn of the
// camera, for which maps are kept.
TEST_F(Shadows, LightThroughGlass_IsAsRaysHaveIt) {
    SceneMaker maker;
    scene::Material glass = chalk();
    glass.base_color = {0.9F, 0.8F, 0.7F, 1};
    glass.transmission.strength = 0.7F;
    glass.double_sided = true;
    maker.add(ground(8)).point({0, 4, 0}, 20, 8);
    maker.add(quad({-1.5, 1, 1.5}, {3, 0, 0}, {0, 0, -3}, 1, maker.add(glass)));
    maker.add(quad({-0.5, 2, 0.5}, {1, 0, 0}, {0, 0, -1}, 1, 0)); // before the glass, and solid
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    for (const double x : {0.0, 2.0}) {
        auto inputs = inputsFrom({x, 3, 8}, {0, 0, 0}, {1, 512});
        inputs.settings.size = {160, 90};
        const Picture picture = draw(view, inputs);
        const auto seen = render::readVisibility(renderer, maker.scene, inputs);
        ASSERT_TRUE(seen);
        const auto by_rays = reference::shade(maker.scene, inputs.settings, 0, *seen);
        ASSERT_TRUE(by_rays);
        size_t differing = 0;
        for (size_t i = 0; i < picture.radiance.size(); ++i) {
            const float value = by_rays->rgb[i];
            differing += std::abs(picture.radiance[i] - value) > 0.04F * (value + 0.02F) ? 1U : 0U;
        }
        EXPECT_LT(differing, picture.radiance.size() / 25); // at edges, a texel wide
    }
}

// Against rays in double: pixels differ only within two texels of a shadow's edge. A pixel's texels
// are unknown here, so its neighbours stand for them: where none differs in how much of the light
// it gets, there is no edge.
TEST_F(Shadows, APlainRoom_IsAsRaysHaveIt_ButAtEdges) {
    auto room = plainRoom();
    scene::PunctualLight lamp;
    lamp.range_m = 12;
    lamp.intensity = 8;
    for (const dvec3& position : {dvec3(0.3, 2.7, 1.6), dvec3(-4, 1.2, 2), dvec3(1.3, 0.6, 1.2)}) {
        lamp.position_world = position;
        room.lights = {lamp};
        render::Renderer renderer(device(), room);
        render::ViewRenderer view(renderer);
        for (const auto& camera : room.cameras) {
            auto inputs = inputsFrom({0, 0, 0}, {0, 0, -1}, {1, 512});
            inputs.settings.size = {240, 135};
            inputs.settings.camera = camera.camera;
            const Picture picture = draw(view, inputs);
            const auto seen = render::readVisibility(renderer, room, inputs);
            ASSERT_TRUE(seen);
            const auto by_rays = reference::shade(room, inputs.settings, 0, *seen);
            auto open = inputs.settings;
            open.shadows = {};
            const auto unshadowed = reference::shade(room, open, 0, *seen);
            ASSERT_TRUE(by_rays && unshadowed);
            const auto blocked = [&](size_t pixel) {
                return by_rays->rgb[3 * pixel] == 0 && unshadowed->rgb[3 * pixel] > 0;
            };
            size_t differing = 0;
            size_t away_from_edges = 0;
            size_t dark = 0;
            for (int y = 0; y < 135; ++y) {
                for (int x = 0; x < 240; ++x) {
                    const size_t pixel = static_cast<size_t>(y * 240 + x);
                    dark += blocked(pixel) ? 1U : 0U;
                    const auto value = static_cast<double>(by_rays->rgb[3 * pixel]);
                    const auto error =
                        std::abs(static_cast<double>(picture.radiance[3 * pixel]) - value);
                    if (error <= 1e-4 * (value + 0.01)) {
                        continue;
                    }
                    ++differing;
                    const bool edge = anyNear(x, y, [&](size_t other) {
                        return blocked(other) != blocked(pixel) ||
                               surfaceOf(*seen, other) != surfaceOf(*seen, pixel);
                    });
                    away_from_edges += edge ? 0U : 1U;
                }
            }
            std::printf("shadows against rays: %zu of 32400 pixels differ, %zu away from edges, "
                        "%zu blocked\n",
                        differing, away_from_edges, dark);
            EXPECT_GT(dark, 300U);
            EXPECT_LT(differing, 32400U / 100);
            EXPECT_EQ(away_from_edges, 0U);
        }
    }
}

// Nothing that casts shadows: glass alone, and a lamp's own glowing shell. Maps without a draw made
// lavapipe 22.3 die.
TEST_F(Shadows, ASceneWithoutCasters_IsLitAsWithoutMaps) {
    for (const bool glows : {false, true}) {
        auto scene = makeRoom();
        for (auto& material : scene.materials) {
            material.emissive_texture = {};
            material.emissive = glm::vec3(glows ? 0.1F : 0);
            material.alpha_mode = glows ? scene::AlphaMode::kOpaque : scene::AlphaMode::kBlend;
        }
        render::Renderer renderer(device(), scene);
        for (const auto kind :
             {settings::Renderer::kForwardPlus, settings::Renderer::kClusteredDeferred}) {
            render::FrameInputs inputs;
            inputs.settings.camera = scene.cameras[0].camera;
            inputs.settings.size = {96, 54};
            inputs.settings.renderer = kind;
            inputs.settings.lighting = settings::LightingStage::kFragment;
            inputs.settings.lights.count = 20;
            const Picture plain = draw(renderer, inputs);
            inputs.settings.shadows.light_count = 2;
            EXPECT_EQ(differingFloats(plain, draw(renderer, inputs)), 0U);
        }
    }
}

// Bumps of a coat face a lamp that is below the floor: what the lamp sends ends at the floor,
// though nothing of the floor's own faces it.
TEST_F(Shadows, ACoatThatFacesALampBelow_IsInTheShadowOfWhatItCovers) {
    auto room = makeRoom();
    room.instances.resize(1); // the floor
    auto& floor = room.materials[0];
    floor.normal_texture = {};
    floor.double_sided = true;
    floor.coat = {.strength = 1, .roughness = 0.5F, .normal_scale = 3};
    floor.coat_normal_texture.texture = 1;
    render::Renderer renderer(device(), room);
    const auto brightest = [&](uint32_t maps) {
        auto inputs = inputsFrom({0, 2, 4}, {0, 0, 0}, {maps, 256});
        inputs.settings.shading = settings::ShadingModel::kPbr;
        inputs.settings.lights.ambient = 0;
        inputs.settings.lights.placed = settings::PlacedLights(
            {{.id = 1, .position_world = {0, -0.4, -1}, .intensity = 20, .radius_m = 8}});
        const Picture picture = draw(renderer, inputs);
        return *std::ranges::max_element(picture.radiance);
    };
    EXPECT_GT(brightest(0), 0.01F) << "there is something to be in shadow";
    EXPECT_EQ(brightest(1), 0);
}

// A lamp below a floor that lets its light through: the floor is in no shadow of its own, on
// neither side, and in that of what stands between.
TEST_F(Shadows, ASheetThatLetsLightThrough_IsInNoShadowOfItsOwn) {
    for (const bool blocked : {false, true}) {
        SceneMaker maker;
        maker.add(ground(4));
        maker.scene.materials[0].double_sided = true;
        maker.scene.materials[0].diffuse_transmission.strength = 0.7F;
        if (blocked) {
            maker.add(quad({-1, -0.3F, 0}, {2, 0, 0}, {0, 0, -2}, 1, 0));
        }
        render::Renderer renderer(device(), maker.scene);
        const auto drawn = [&](uint32_t maps) {
            auto inputs = inputsFrom({0, 2, 4}, {0, 0, 0}, {maps, 256});
            inputs.settings.shading = settings::ShadingModel::kPbr;
            inputs.settings.lights.ambient = 0;
            inputs.settings.lights.placed = settings::PlacedLights(
                {{.id = 1, .position_world = {0, -0.8, -1}, .intensity = 20, .radius_m = 8},
                 {.id = 2, .position_world = {1, 1.5, 0}, .intensity = 20, .radius_m = 8}});
            return draw(renderer, inputs);
        };
        const Picture open = drawn(0);
        const Picture shadowed = drawn(2);
        const size_t differing = differingFloats(open, shadowed);
        EXPECT_TRUE(blocked ? differing > 100 : differing == 0) << differing;
        for (size_t i = 0; i < open.radiance.size(); ++i) {
            ASSERT_LE(shadowed.radiance[i], open.radiance[i]);
        }
    }
}

// As many lights as may have maps, each with shadows of its own: together they are the sum of what
// each is alone. Levels are kept in 4 bits a light, eight lights a word.
TEST_F(Shadows, ThirtyTwoLights_EachHaveTheirOwn) {
    SceneMaker maker;
    maker.add(ground(4));
    for (const float x : {-1.5F, 0.0F, 1.5F}) {
        maker.add(quad({x, 0.4F, 0.5F}, {0.5F, 0, 0}, {0, 0, -0.5F}, 1, 0));
    }
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    const auto drawnWith = [&](const std::vector<settings::PlacedLight>& lights) {
        auto inputs = inputsFrom({0, 3, 5}, {0, 0, 0}, {32, 64});
        inputs.settings.renderer = Renderer::kNaive;
        inputs.settings.lights.placed = settings::PlacedLights(lights);
        return draw(view, inputs);
    };
    std::vector<settings::PlacedLight> lights;
    std::vector<double> sum;
    for (uint32_t i = 0; i < 32; ++i) {
        const double turn = glm::radians(360.0 / 32 * i);
        lights.push_back({.id = i + 1,
                          .position_world = {3 * std::sin(turn), 1.2, 2 * std::cos(turn)},
                          .intensity = 3,
                          .radius_m = 8});
        const Picture alone = drawnWith({lights.back()});
        sum.resize(alone.radiance.size());
        for (size_t j = 0; j < sum.size(); ++j) {
            sum[j] += static_cast<double>(alone.radiance[j]);
        }
    }
    const Picture all = drawnWith(lights);
    EXPECT_EQ(all.stats.steps.count("shadows", "lights"), 32U);
    for (size_t j = 0; j < sum.size(); ++j) {
        ASSERT_NEAR(static_cast<double>(all.radiance[j]), sum[j], 1e-4 * (sum[j] + 0.01)) << j;
    }
}

TEST_F(Shadows, ASpot_IsDarkBehindWhatBlocksIt) {
    for (const double outer_deg : {10.0, 35.0, 60.0, 75.0, 89.0}) {
        SceneMaker maker;
        maker.add(ground(4)).add(quad({-0.25F, 1, 0.25F}, {0.5F, 0, 0}, {0, 0, -0.5F}, 1, 0));
        maker.spot({0, 3, 0}, {0.02, -1, 0.01}, 12, outer_deg * 0.9, outer_deg);
        const auto inputs = inputsFrom({0, 2, 6}, {0, 0, 0}, {1, 256});
        const Picture picture = drawn(maker.scene, inputs, device());
        EXPECT_EQ(picture.stats.steps.count("shadows", "maps"), outer_deg <= 60 ? 1U : 6U);
        EXPECT_EQ(lightAt(picture, inputs.settings, {0.2, 0, 0.2}), 0) << outer_deg;
        EXPECT_EQ(lightAt(picture, inputs.settings, {-0.3, 0, 0}), 0) << outer_deg;
        if (outer_deg > 20) {
            EXPECT_GT(lightAt(picture, inputs.settings, {0.6, 0, 0.3}), 0) << outer_deg;
        }
    }
}

} // namespace froxel::test
