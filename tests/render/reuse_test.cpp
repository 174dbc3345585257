// What rests is not drawn again, and nobody can tell from a picture.
#include "render/view/renderer.h"
#include "settings/setting_rows.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/setting_values.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <random>
#include <string>

namespace froxel::test {

namespace {

using settings::Renderer;

class Reuse : public SharedGpuTest {
  protected:
    static void TearDownTestSuite() {
        renderer_.reset();
        SharedGpuTest::TearDownTestSuite();
    }
    // Of all tests, as its pipelines are: solid, masked, coated and blended surfaces.
    [[nodiscard]] static render::Renderer& renderer() {
        if (!renderer_) {
            renderer_ = std::make_unique<render::Renderer>(device(), room());
        }
        return *renderer_;
    }
    static const scene::Scene& room() {
        static const scene::Scene scene = [] {
            scene::Scene made = makeRoom();
            made.materials[0].coat.strength = 0.7F;
            made.materials[4].metallic_roughness_texture.texture = 0; // which lambert leaves out
            return made;
        }();
        return scene;
    }
    [[nodiscard]] static render::FrameInputs inputs(Renderer kind = Renderer::kClusteredDeferred) {
        render::FrameInputs inputs;
        inputs.settings.camera = room().cameras[0].camera;
        inputs.settings.size = {72, 40};
        inputs.settings.renderer = kind;
        inputs.settings.lights.count = 20;
        inputs.time_s = 1;
        inputs.keep_surfaces = true;
        inputs.spoil_scratch = true;
        return inputs;
    }
    // The view's next frame, which may keep what it has, against a view's first.
    static Picture expectAsAnew(render::ViewRenderer& view, const render::FrameInputs& inputs) {
        render::FrameInputs whole = inputs;
        whole.keep_surfaces = false;
        render::ViewRenderer anew(renderer());
        const auto submitted = view.submit(inputs);
        const auto expected = anew.submit(whole);
        EXPECT_EQ(submitted.has_value(), expected.has_value());
        if (!submitted || !expected) {
            EXPECT_EQ(submitted ? "" : submitted.error().message,
                      expected ? "" : expected.error().message);
            return {};
        }
        const Picture picture = collectPixels(view);
        const Picture first = collectPixels(anew);
        EXPECT_FALSE(first.stats.surfaces_reused);
        EXPECT_EQ(picture.rgba8, first.rgba8);
        EXPECT_EQ(differingFloats(picture, first), 0U);
        return picture;
    }

  private:
    inline static std::unique_ptr<render::Renderer> renderer_;
};

// With the row at another value than the view has it.
void change(const settings::SettingOf<settings::ViewSettings>& row, render::FrameInputs& inputs) {
    row.set(inputs.settings, otherValue(row, row.get(inputs.settings)));
}

std::string nameOf(Renderer kind) {
    return std::string(settings::kRendererNames[static_cast<size_t>(kind)]);
}

} // namespace

// Lights that move are no reason to draw surfaces again. All renderers that have a part to keep.
TEST_F(Reuse, MovingLights_BeforeSurfacesThatRest_DrawThemOnce) {
    for (const auto path :
         {render::GeometryPath::kAuto, render::GeometryPath::kRaster,
          render::GeometryPath::kVisibility, render::GeometryPath::kComputeRaster}) {
        for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
            const auto renderer = static_cast<Renderer>(kind);
            SCOPED_TRACE(nameOf(renderer));
            render::ViewRenderer view(Reuse::renderer());
            auto asked = inputs(renderer);
            asked.geometry = path;
            asked.depth_prepass = renderer != Renderer::kNaive;
            asked.outputs = {Output::kRadiance};
            (void)expectAsAnew(view, asked); // counts what is drawn over what
            asked.time_s = 2;
            (void)expectAsAnew(view, asked);
            asked.time_s = 3;
            const Picture third = expectAsAnew(view, asked);
            asked.time_s = 4;
            const Picture fourth = expectAsAnew(view, asked);
            const bool keeps = renderer != Renderer::kNaive || hasPass(fourth, "shade");
            EXPECT_EQ(third.stats.surfaces_reused, keeps);
            EXPECT_EQ(fourth.stats.surfaces_reused, keeps);
            for (const char* pass :
                 {"depth_prepass", "gbuffer", "visibility", "raster_meshlets", "cull", "resolve"}) {
                EXPECT_FALSE(keeps && hasPass(fourth, pass)) << pass;
            }
            asked.settings.camera.eye_world.x += 0.01;
            EXPECT_FALSE(expectAsAnew(view, asked).stats.surfaces_reused);
            asked.keep_surfaces = false;
            EXPECT_FALSE(expectAsAnew(view, asked).stats.surfaces_reused);
        }
    }
}

namespace {

// Settings in which every other one shows: all effects at once.
void turnEverythingOn(settings::ViewSettings& settings) {
    settings.renderer = Renderer::kToonCompute;
    settings.lights.ambient = 0.1F;
    settings.lights.cutoff = 0.05F;
    settings.toon.bands = 0; // steps hide what is small
    settings.toon_outline.strength = 0.5F;
    settings.bloom.kind = settings::BloomKind::kMipChain;
    settings.bloom.threshold = 0.3F;
    settings.fog.density = 0.03F;
    settings.fog.noise = true;
    settings.fog.height_falloff = 0.5F;
    settings.gbuffer.position = settings::PositionSource::kFp32; // the next is rounded
    settings.transparency = settings::Transparency::kPeeled;
    settings.peel_layers = 1;
    settings.shadows.light_count = 1;
    std::vector<settings::PlacedLight> lamps;
    for (uint32_t id = 1; id <= 3; ++id) {
        const glm::dvec3 at(1.5 * id - 3, 2, 0.5 * id);
        lamps.push_back({.id = id, .position_world = at, .intensity = 4, .radius_m = 5});
    }
    settings.lights.placed = settings::PlacedLights(lamps);
    settings.environment = {settings::EnvironmentLight::kStudio, 40, 1, true};
}

// What leaves a picture to the bit.
bool leavesThePicture(std::string_view setting) {
    constexpr std::array kNames = std::to_array<std::string_view>({
        "lighting", "light_loop", "grid_law", "count_pairs", // other ways to the same
        "debug_scale_max",                                   // of a view that is off
        "animate", "light_speed",                            // are in the lights' clock already
        "scene_lights", "scene_light_intensity", "animation_playing", "animation_speed",
        "animation_repeat",
        "animation_fade",                          // the room has none
        "ambient",                                 // gives way to what is around
        "background_color", "background_gradient", // are behind that
        "outline_width",                           // a pixel at least, which this is
        "geometry_error",                          // the room has no coarser levels
    });
    return std::ranges::find(kNames, setting) != kNames.end();
}

} // namespace

// Each row of the settings' table by itself, after a frame that was kept, and back. It does
// something.
TEST_F(Reuse, AnySetting_ChangedAlone_GivesThePictureOfAFreshView) {
    render::ViewRenderer view(renderer());
    auto base = inputs();
    base.outputs = {Output::kRadiance};
    turnEverythingOn(base.settings);
    const Picture at_rest = expectAsAnew(view, base);
    for (const auto& row : settings::kSettingRows) {
        SCOPED_TRACE(std::string(row.name));
        auto changed = base;
        change(row, changed);
        const Picture other = expectAsAnew(view, changed);
        const bool same = other.rgba8 == at_rest.rgba8 && differingFloats(other, at_rest) == 0;
        EXPECT_EQ(same, leavesThePicture(row.name));
        const Picture back = drawPixels(view, base);
        EXPECT_EQ(back.rgba8, at_rest.rgba8);
        EXPECT_EQ(drawPixels(view, base).rgba8, at_rest.rgba8);
    }
}

// Settings, time, camera and size go at random ways; most frames keep what they can.
TEST_F(Reuse, RandomWalk_EachFrame_IsThatOfAFreshView) {
    std::mt19937 random(11);
    const auto one_of = [&](size_t count) { return random() % count; };
    render::ViewRenderer view(renderer());
    render::ViewRenderer other(renderer());
    auto elsewhere = inputs();
    elsewhere.settings.camera = room().cameras[1].camera;
    elsewhere.settings.size = {40, 40};
    auto asked = inputs();
    asked.outputs = {Output::kRadiance};
    const auto base = asked.settings;
    size_t reused_count = 0;
    const size_t steps = wholeGrids() ? 3000 : 200;
    for (size_t step = 0; step < steps; ++step) {
        SCOPED_TRACE(step);
        const auto before = asked.settings;
        asked.time_s += 0.1;
        if (one_of(20) == 0) {
            asked.settings = base;
        } else if (one_of(3) == 0) {
            const auto& row = settings::kSettingRows[one_of(std::size(settings::kSettingRows))];
            SCOPED_TRACE(std::string(row.name));
            change(row, asked);
        } else if (one_of(6) == 0) {
            asked.settings.size = one_of(2) == 0 ? settings::Size{40, 72} : settings::Size{72, 40};
        } else if (one_of(6) == 0) {
            asked.settings.camera = room().cameras[one_of(room().cameras.size())].camera;
        }
        (void)drawPixels(other, elsewhere); // leaves its own in whatever views share
        const Picture picture = expectAsAnew(view, asked);
        reused_count += picture.stats.surfaces_reused ? 1U : 0U;
        if (picture.rgba8.empty()) { // refused
            asked.settings = before;
        }
        if (HasFailure()) {
            return;
        }
    }
    EXPECT_GT(reused_count, steps / 8);
}

// Maps of lights that rest stay, beside those of lights that move and while the camera moves.
TEST_F(Reuse, ShadowMaps_OfLightsThatRest_AreDrawnOnce) {
    render::ViewRenderer view(renderer());
    auto asked = inputs();
    asked.settings.camera = room().cameras[0].camera;
    asked.settings.shadows.light_count = 4;
    asked.settings.lights.count = 0;
    settings::PlacedLight lamp{
        .id = 1, .position_world = {0, 1.5, 0.5}, .intensity = 4, .radius_m = 4};
    settings::PlacedLight spot{.id = 2,
                               .kind = settings::LightKind::kSpot,
                               .position_world = {0.5, 2, 0},
                               .intensity = 4,
                               .radius_m = 5};
    const auto place = [&] { asked.settings.lights.placed = settings::PlacedLights({lamp, spot}); };
    const auto expect = [&](uint32_t maps, uint32_t kept) {
        asked.time_s += 0.1;
        const Picture picture = expectAsAnew(view, asked);
        EXPECT_EQ(picture.stats.steps.count("shadows", "maps"), maps);
        EXPECT_EQ(picture.stats.steps.count("shadows", "kept"), kept);
        EXPECT_EQ(hasPass(picture, "shadows"), kept < maps);
    };
    place();
    expect(7, 0);
    expect(7, 7);
    asked.settings.camera = room().cameras[1].camera;
    expect(7, 7);
    asked.settings.camera = room().cameras[0].camera;
    spot.position_world.x -= 0.1;
    place();
    expect(7, 6);
    lamp.position_world.y -= 0.1;
    place();
    expect(7, 1);
    asked.settings.shadows.size_px /= 2;
    expect(7, 0);
    expect(7, 7);
    asked.settings.lights.placed = settings::PlacedLights({spot});
    expect(1, 0);
    place();
    expect(7, 0);
    asked.settings.shadows.light_count = 0;
    expect(0, 0);
    asked.settings.shadows.light_count = 4;
    expect(7, 0);
    asked.keep_surfaces = false;
    expect(7, 0);
    asked.keep_surfaces = true;
    expect(7, 0);
    asked.settings.lights.count = 3; // which move
    expect(19, 0);
    asked.time_s += 0.1;
    const uint64_t kept = expectAsAnew(view, asked).stats.steps.count("shadows", "kept");
    EXPECT_GE(kept, 1U); // the spot's, and what shows nothing
    EXPECT_LT(kept, 19U);
}

// A frame that was given up half drawn leaves nothing to keep.
TEST_F(Reuse, FrameGivenUp_IsDrawnAnew) {
    render::ViewRenderer view(renderer(), {}, {Seconds(100), Seconds(1e-5)});
    auto asked = inputs();
    (void)expectAsAnew(view, asked);
    asked.settings.camera = room().cameras[1].camera;
    const auto begun = view.begin(asked);
    ASSERT_TRUE(begun && begun->piece_count > 1);
    ASSERT_TRUE(view.submitPiece());
    view.abandon();
    ASSERT_TRUE(view.collectPiece());
    EXPECT_FALSE(expectAsAnew(view, asked).stats.surfaces_reused);
    asked.settings.camera = room().cameras[0].camera;
    EXPECT_FALSE(expectAsAnew(view, asked).stats.surfaces_reused);
}

} // namespace froxel::test
