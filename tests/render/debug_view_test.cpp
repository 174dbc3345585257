// Debug views against what the host knows, pixel by pixel.
#include "cluster/light_assigner.h"
#include "interface/debug_io.h"
#include "interface/heat_map.h"
#include "light/light_rig.h"
#include "render/scene/scene_resources.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <cmath>
#include <map>

namespace froxel::test {

namespace {

using settings::DebugView;
using settings::Renderer;

constexpr settings::Size kSize{96, 54};

class DebugViews : public SharedGpuTest {};

render::FrameInputs inputsFor(DebugView debug, const settings::Camera& camera = {}) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = kSize;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.settings.lights.count = 60;
    inputs.settings.debug.view = debug;
    inputs.time_s = 2;
    return inputs;
}

struct Shown {
    std::vector<uint32_t> words; // RGBA8
    FrameStats stats;
    [[nodiscard]] uint32_t at(uint32_t x, uint32_t y) const {
        return words[y * kSize.width_px + x];
    }
};

Shown show(render::ViewRenderer& view, const render::FrameInputs& inputs) {
    const Picture picture = drawPixels(view, inputs);
    Shown shown{std::vector<uint32_t>(picture.rgba8.size() / 4), picture.stats};
    std::memcpy(shown.words.data(), picture.rgba8.data(), picture.rgba8.size());
    return shown;
}

Shown show(render::Renderer& renderer, const render::FrameInputs& inputs) {
    render::ViewRenderer view(renderer);
    return show(view, inputs);
}

// Positions on the colour map of a picture; empty pixels are left out.
std::vector<uint32_t> positions(const Shown& shown) {
    std::map<uint32_t, uint32_t> known;
    for (uint32_t i = 0; i <= io::kHeatTop; ++i) {
        known[io::heatColor(i)] = i;
    }
    std::vector<uint32_t> found;
    for (const uint32_t word : shown.words) {
        if (word == io::kDebugEmpty) {
            continue;
        }
        const auto position = known.find(word);
        if (position == known.end()) {
            ADD_FAILURE() << std::hex << word << " is no colour of the map";
            return found;
        }
        found.push_back(position->second);
    }
    return found;
}

uint64_t sum(const std::vector<uint32_t>& values) {
    uint64_t total = 0;
    for (const uint32_t value : values) {
        total += value;
    }
    return total;
}

int channel(uint32_t word, uint32_t index) {
    return static_cast<int>(word >> (8 * index) & 255U);
}

size_t differing(const Shown& a, const Shown& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.words.size(); ++i) {
        count += a.words[i] != b.words[i] ? 1U : 0U;
    }
    return count;
}

// A wall that fills the view, with all depths equal, and lights before it.
constexpr float kWall_m = 6.3F;

scene::Scene wall() {
    return wallAhead(kWall_m).scene;
}

render::FrameInputs wallInputs(DebugView debug) {
    auto inputs = inputsFor(debug);
    inputs.settings.lights.box = BoundsD3{{-6, -3, -9}, {6, 3, -4}};
    inputs.settings.grid = {.automatic = false, .size = {12, 7, 20}};
    inputs.settings.debug.scale_max = io::kHeatTop; // a step a light
    return inputs;
}

} // namespace

TEST_F(DebugViews, ListsSlicesAndTiles_AtEveryPixel_AreTheHosts) {
    const auto scene = wall();
    render::Renderer renderer(device(), scene);
    const auto inputs = wallInputs(DebugView::kListedLights);
    const Shown lists = show(renderer, inputs);
    const Shown slices = show(renderer, wallInputs(DebugView::kClusterSlices));
    const Shown tiles = show(renderer, wallInputs(DebugView::kClusterTiles));

    const auto& settings = inputs.settings;
    light::FrameLights lights;
    light::LightRig(scene).evaluate(settings.lights, settings.camera, inputs.time_s, lights);
    const GridStats& used = lists.stats.grid;
    const auto grid = cluster::makeClusterGrid({.size = settings.grid.size}, kSize, settings.camera,
                                               used.near_m, used.far_m);
    cluster::LightLists expected;
    cluster::LightAssigner assigner(1);
    assigner.assign(grid, lights, expected);
    const uint32_t slice = grid.sliceAt(kWall_m).value();
    uint32_t most = 0;
    for (uint32_t y = 0; y < kSize.height_px; ++y) {
        for (uint32_t x = 0; x < kSize.width_px; ++x) {
            const uint32_t column = x / grid.tile_width_px;
            const uint32_t row = y / grid.tile_height_px;
            const auto& list = expected.clusters[grid.clusterIndex(column, row, slice)];
            most = std::max(most, list.count);
            ASSERT_EQ(lists.at(x, y), io::heatColor(list.count)) << x << "," << y;
            ASSERT_EQ(slices.at(x, y), io::heatColor(slice)) << x << "," << y;
            ASSERT_EQ(channel(tiles.at(x, y), 0), static_cast<int>(column * 255 / 11));
            ASSERT_EQ(channel(tiles.at(x, y), 1), static_cast<int>(row * 255 / 6));
        }
    }
    EXPECT_GT(most, 3U);
}

TEST_F(DebugViews, Counts_EveryRenderer_AddUpToThePairCounts) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto kind :
         {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        SCOPED_TRACE(settings::kRendererNames[static_cast<size_t>(kind)]);
        auto inputs = inputsFor(DebugView::kEvaluatedLights, scene.cameras[0].camera);
        inputs.settings.renderer = kind;
        inputs.settings.count_pairs = true;
        inputs.settings.debug.scale_max = io::kHeatTop;
        const Shown evaluated = show(view, inputs);
        inputs.settings.debug.view = DebugView::kContributingLights;
        const Shown contributing = show(view, inputs);
        const StepStats& stats = contributing.stats.steps;
        EXPECT_GT(stats.count("pairs", "contributing"), 0U);
        EXPECT_EQ(sum(positions(evaluated)), stats.count("pairs", "evaluated"));
        EXPECT_EQ(sum(positions(contributing)), stats.count("pairs", "contributing"));

        inputs.settings.debug.view = DebugView::kFalsePositives;
        const auto shares = positions(show(view, inputs));
        const auto looped = positions(evaluated);
        const auto reached = positions(contributing);
        ASSERT_EQ(shares.size(), looped.size());
        for (size_t i = 0; i < shares.size(); ++i) {
            ASSERT_EQ(shares[i], io::heatPosition(looped[i] - reached[i], std::max(looped[i], 1U)));
        }
    }
}

TEST_F(DebugViews, Materials_OfAWall_AreItsOwn) {
    const auto scene = wall(); // white, rough, no metal
    render::Renderer renderer(device(), scene);
    const uint32_t x = 50;
    const uint32_t y = 20;
    const uint32_t normal = show(renderer, wallInputs(DebugView::kNormal)).at(x, y);
    EXPECT_NEAR(channel(normal, 0), 128, 1);
    EXPECT_NEAR(channel(normal, 1), 128, 1);
    EXPECT_EQ(channel(normal, 2), 255);
    EXPECT_EQ(show(renderer, wallInputs(DebugView::kBaseColor)).at(x, y), 0xffffffffU);
    const uint32_t rough = show(renderer, wallInputs(DebugView::kRoughness)).at(x, y);
    EXPECT_EQ(rough, 0xff00ffffU); // occlusion and roughness 1, metalness 0

    auto inputs = wallInputs(DebugView::kDepth);
    inputs.settings.debug.scale_max = 8;
    const Shown depth = show(renderer, inputs);
    const auto at = static_cast<uint32_t>(kWall_m / 8 * io::kHeatTop);
    EXPECT_EQ(depth.at(x, y), io::heatColor(at));
    ASSERT_TRUE(depth.stats.details->legend);
    EXPECT_EQ(depth.stats.details->legend->max, 8);

    // A wall of a box without depth: x and y run over the box, from the left and from below.
    const Shown places = show(renderer, wallInputs(DebugView::kPosition));
    const double half_height = std::tan(wallInputs(DebugView::kNone).settings.camera.yfov_rad / 2);
    const double across = half_height * kWall_m * 96 / 54 * ((x + 0.5) / 48 - 1);
    const auto& box = scene.bounds_world;
    EXPECT_NEAR(channel(places.at(x, y), 0), 255 * (across - box.min.x) / box.size().x, 1);
    EXPECT_GT(channel(places.at(x, 5), 1), channel(places.at(x, 40), 1));
}

TEST_F(DebugViews, Gbuffer_OfAWall_ShowsTheBytesStored) {
    const auto scene = wall();
    render::Renderer renderer(device(), scene);
    const auto inputs = wallInputs(DebugView::kGbuffer);
    const Shown bytes = show(renderer, inputs);
    const auto cell = [&](uint32_t column, uint32_t row) {
        return bytes.at(column * 24 + 5, row * 13 + 5);
    };
    for (uint32_t column = 0; column < 4; ++column) {
        EXPECT_EQ(cell(column, 0), 0xff000000U);     // the normal (0, 0, 1): two components of 0
        EXPECT_EQ(cell(column, 1), 0xffffffffU);     // white, roughness 1
        EXPECT_EQ(cell(column, 2), io::kDebugEmpty); // a thin G-buffer
    }
    auto extra = wallInputs(DebugView::kGbufferExtra);
    extra.settings.gbuffer.position = settings::PositionSource::kFp32;
    const Shown places = show(renderer, extra);
    float z = 0;
    uint32_t word = 0;
    for (uint32_t column = 0; column < 4; ++column) {
        word |= (places.at(column * 24 + 5, 2 * 13 + 5) & 255U) << (8 * column);
    }
    std::memcpy(&z, &word, sizeof z);
    EXPECT_NEAR(z, -kWall_m, 1e-5);
}

TEST_F(DebugViews, ForwardRenderers_ShowWhatDeferredOnesDo) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto debug :
         {DebugView::kPosition, DebugView::kDepth, DebugView::kNormal, DebugView::kBaseColor,
          DebugView::kRoughness, DebugView::kClusterSlices, DebugView::kListedLights}) {
        SCOPED_TRACE(settings::nameOf(debug));
        auto inputs = inputsFor(debug, scene.cameras[0].camera);
        inputs.settings.grid = {.automatic = false, .size = {8, 8, 8}};
        const Shown deferred = show(view, inputs);
        std::map<uint32_t, uint32_t> colors;
        for (const uint32_t word : deferred.words) {
            ++colors[word];
        }
        EXPECT_GT(colors.size(), 2U);
        for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus}) {
            inputs.settings.renderer = kind;
            EXPECT_EQ(differing(deferred, show(view, inputs)), 0U);
        }
    }
}

TEST_F(DebugViews, Overdraw_AddsUpToTheSamplesThatPass) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(DebugView::kNone, scene.cameras[0].camera);
    inputs.depth_prepass = false;
    (void)show(view, inputs); // counts them
    const auto counted = renderer.resources().overdraw;
    if (!counted) {
        GTEST_SKIP() << "this device counts no samples";
    }
    inputs.settings.debug.view = DebugView::kOverdraw;
    inputs.settings.debug.scale_max = io::kHeatTop;
    const double pixels = 1.0 * kSize.width_px * kSize.height_px;
    const uint64_t fragments = sum(positions(show(view, inputs)));
    EXPECT_GT(fragments, 0U);
    EXPECT_DOUBLE_EQ(static_cast<double>(fragments) / pixels, *counted);
}

namespace {

// A square that faces the eye; x, y: of its lower left corner.
scene::Primitive squareAt(float x, float y, float distance_m, uint32_t material) {
    constexpr float kSide_m = 20;
    return quad({x, y, -distance_m}, {kSide_m, 0, 0}, {0, kSide_m, 0}, 1, material);
}

scene::Material ofAlpha(scene::AlphaMode mode, float alpha) {
    scene::Material material = chalk();
    material.alpha_mode = mode;
    material.base_color.w = alpha;
    return material;
}

uint32_t colorOfInstance(uint32_t instance) {
    const uint32_t product = (instance + 1) * io::kInstanceColorFactor & io::kInstanceColorMask;
    return io::kDebugEmpty ^ product;
}

} // namespace

// A wall; before its right half another; nearer, from left to right and below, what is cut away,
// what a mask keeps, what is blended; nearest and over all of it, what shows nothing.
TEST_F(DebugViews, Instances_AtEveryPixel_AreTheNearestThatShow) {
    using scene::AlphaMode;
    auto maker = wallAhead(kWall_m);
    const uint32_t cut = maker.add(ofAlpha(AlphaMode::kMask, 0.2F));
    const uint32_t kept = maker.add(ofAlpha(AlphaMode::kMask, 0.8F));
    const uint32_t blended = maker.add(ofAlpha(AlphaMode::kBlend, 0.3F));
    const uint32_t nothing = maker.add(ofAlpha(AlphaMode::kBlend, 0));
    maker.add(squareAt(0, -10, 4, 0))
        .add(squareAt(-20, -20, 3, cut))
        .add(squareAt(-20, -20, 3.5F, kept))
        .add(squareAt(0, -20, 3, blended))
        .add(squareAt(-10, -10, 1, nothing));
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(DebugView::kInstances);
    for (const auto kind :
         {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        inputs.settings.renderer = kind;
        const Shown shown = show(view, inputs);
        for (uint32_t y = 0; y < kSize.height_px; ++y) {
            for (uint32_t x = 0; x < kSize.width_px; ++x) {
                const bool right = x >= kSize.width_px / 2;
                const bool below = y >= kSize.height_px / 2;
                const uint32_t nearest = right ? (below ? 4 : 1) : (below ? 3 : 0);
                ASSERT_EQ(shown.at(x, y), colorOfInstance(nearest)) << x << "," << y;
            }
        }
    }
}

TEST_F(DebugViews, Instances_WhereNothingIs_AreEmpty) {
    SceneMaker maker;
    maker.add(squareAt(0, -10, 4, 0));
    render::Renderer renderer(device(), maker.scene);
    const Shown shown = show(renderer, inputsFor(DebugView::kInstances));
    EXPECT_EQ(shown.at(47, 20), io::kDebugEmpty);
    EXPECT_EQ(shown.at(48, 20), colorOfInstance(0));
}

TEST_F(DebugViews, LightSpheres_OfOneLight_HitItsCircleAndNothingElse) {
    auto maker = wallAhead(40);
    const glm::dvec3 place(1, 0.5, -10);
    const float radius_m = 2;
    maker.point(place, radius_m);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(DebugView::kNone);
    inputs.settings.lights.count = 0;
    const Shown before = show(renderer, inputs);
    inputs.settings.debug.view = DebugView::kLightSpheres;
    const Shown wires = show(renderer, inputs);
    const double focal_px = kSize.height_px / 2.0 / std::tan(inputs.settings.camera.yfov_rad / 2);
    const auto changed = [&](double x, double y) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto px = static_cast<uint32_t>(x + dx);
                const auto py = static_cast<uint32_t>(y + dy);
                if (wires.at(px, py) != before.at(px, py)) {
                    return true;
                }
            }
        }
        return false;
    };
    const double middle_x = kSize.width_px / 2.0 + focal_px * place.x / -place.z;
    const double middle_y = kSize.height_px / 2.0 + focal_px * place.y / place.z;
    const double radius_px = focal_px * static_cast<double>(radius_m) / -place.z;
    for (int i = 0; i < 64; ++i) {
        const double angle = i * 2 * glm::pi<double>() / 64;
        EXPECT_TRUE(
            changed(middle_x + radius_px * std::cos(angle), middle_y + radius_px * std::sin(angle)))
            << i;
    }
    size_t outside = 0;
    for (uint32_t y = 0; y < kSize.height_px; ++y) {
        for (uint32_t x = 0; x < kSize.width_px; ++x) {
            // The sphere's outline, nearer than its middle, is a little larger than the circle.
            const double away = std::hypot(x + 0.5 - middle_x, y + 0.5 - middle_y);
            outside += away > 1.2 * radius_px + 2 && wires.at(x, y) != before.at(x, y) ? 1U : 0U;
        }
    }
    EXPECT_EQ(outside, 0U);
    EXPECT_FALSE(changed(middle_x + 0.4 * radius_px, middle_y + 0.5 * radius_px));
}

TEST_F(DebugViews, ClusterWires_OfTheViewsCamera_LieOnTileBorders) {
    const auto scene = wall();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = wallInputs(DebugView::kNone);
    const Shown before = show(view, inputs);
    inputs.settings.debug.view = DebugView::kClusterWires;
    const Shown wires = show(view, inputs);
    const uint32_t tile_width = wires.stats.grid.tile_width_px;
    const uint32_t tile_height = wires.stats.grid.tile_height_px;
    const auto nearBorder = [](uint32_t at, uint32_t tile, uint32_t end) {
        return at % tile <= 1 || at % tile == tile - 1 || at + 2 >= end;
    };
    size_t on_borders = 0;
    for (uint32_t y = 0; y < kSize.height_px; ++y) {
        for (uint32_t x = 0; x < kSize.width_px; ++x) {
            if (wires.at(x, y) != before.at(x, y)) {
                ++on_borders;
                ASSERT_TRUE(nearBorder(x, tile_width, kSize.width_px) ||
                            nearBorder(y, tile_height, kSize.height_px))
                    << x << "," << y;
            }
        }
    }
    EXPECT_GT(on_borders, 200U);

    // Frozen there and seen from elsewhere they lie elsewhere, and the picture below has its own
    // grid.
    inputs.settings.debug.grid_camera = inputs.settings.camera;
    EXPECT_EQ(differing(wires, show(view, inputs)), 0U);
    inputs.settings.camera = settings::lookAt({3, 2, 1}, {0, 0, -kWall_m}, {0, 1, 0});
    const Shown frozen = show(view, inputs);
    inputs.settings.debug.grid_camera.reset();
    EXPECT_GT(differing(frozen, show(view, inputs)), 100U);
}

TEST_F(DebugViews, FramesWithout_HaveTheSameBytesAndPasses) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(DebugView::kNone, scene.cameras[0].camera);
    const Shown before = show(view, inputs);
    EXPECT_FALSE(before.stats.details->legend);
    for (size_t i = 1; i < settings::kDebugViewNames.size(); ++i) {
        auto debug = inputs;
        debug.settings.debug.view = static_cast<DebugView>(i);
        debug.settings.gbuffer.position = settings::PositionSource::kStoredDepth;
        const Shown shown = show(view, debug);
        ASSERT_TRUE(shown.stats.details->legend);
        EXPECT_EQ(shown.stats.details->legend->view, settings::kDebugViewNames[i]);
        EXPECT_GT(differing(before, shown), 100U) << settings::kDebugViewNames[i];
    }
    const Shown after = show(view, inputs);
    EXPECT_EQ(differing(before, after), 0U);
    ASSERT_EQ(before.stats.passes.size(), after.stats.passes.size());
    for (size_t i = 0; i < after.stats.passes.size(); ++i) {
        EXPECT_EQ(before.stats.passes[i].name, after.stats.passes[i].name);
    }
}

TEST_F(DebugViews, WhatARendererLacks_IsRefused) {
    const auto scene = wall();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    const auto refused = [&](const render::FrameInputs& inputs) {
        const auto submitted = view.submit(inputs);
        EXPECT_FALSE(submitted);
        return submitted ? std::string() : submitted.error().message;
    };
    auto forward = wallInputs(DebugView::kGbuffer);
    forward.settings.renderer = Renderer::kNaive;
    EXPECT_THAT(refused(forward), ::testing::HasSubstr("renderer naive, which has no G-buffer"));
    EXPECT_THAT(refused(wallInputs(DebugView::kGbufferExtra)), ::testing::HasSubstr("one target"));
    auto linear = wallInputs(DebugView::kNormal);
    linear.outputs = {Output::kRadiance};
    EXPECT_THAT(refused(linear), ::testing::HasSubstr("no linear picture"));
    (void)show(view, wallInputs(DebugView::kNormal));
}

} // namespace froxel::test
