#include "support/settings.h"
#include "unit/session/state_fixture.h"

#include <gtest/gtest.h>

#include <functional>
#include <gmock/gmock.h>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;
using test::changes;
using test::chosen;
using test::settings;
using ::testing::HasSubstr;

SetLights
lights(std::initializer_list<std::pair<std::string_view, settings::SettingValue>> values) {
    return {{changes(values)}, {}, false, {}};
}

TEST_F(State, Initial_HasTheDefaultsAndTheFirstCamera) {
    EXPECT_EQ(initial.settings.camera, context.scene.cameras[0].camera);
    EXPECT_EQ(initial.settings.size, context.defaults.settings.size);
    EXPECT_EQ(initial.encoding, context.defaults.encoding);
    EXPECT_EQ(initial.settings.lights.count, context.defaults.settings.lights.count);
    EXPECT_EQ(initial.applied, CommandStamp{});
    EXPECT_TRUE(initial.animatingAt(kStart));
    EXPECT_EQ(initial.light_clock.secondsAt(kStart), 0);
}

TEST_F(State, Initial_WithoutCameras_SeesTheWholeScene) {
    context.scene.cameras.clear();
    const BoundsD3& bounds = context.scene.bounds_world;
    context.first_view = {};
    context.first_view.sphere_world = {bounds.center(), glm::length(bounds.size()) / 2};
    const settings::Camera camera = initialState(context, kStart).settings.camera;
    const double half_angle = camera.yfov_rad / 2;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 world(corner & 1 ? bounds.max.x : bounds.min.x,
                               corner & 2 ? bounds.max.y : bounds.min.y,
                               corner & 4 ? bounds.max.z : bounds.min.z);
        const glm::dvec3 position_view =
            glm::transpose(camera.world_from_view) * (world - camera.eye_world);
        EXPECT_LT(position_view.z, -camera.near_m);
        EXPECT_LT(std::abs(position_view.y), -position_view.z * std::tan(half_angle));
    }
    context.first_view = {};
    const settings::Camera empty = initialState(context, kStart).settings.camera;
    EXPECT_GT(empty.focus_m, 0);
}

// A window held upright: the opening view steps back, until somebody has moved it.
TEST_F(State, SetSize_OfTheOpeningView_FramesTheSceneAnew) {
    context.scene.cameras.clear();
    context.first_view = {};
    context.first_view.sphere_world = {{1, 2, 3}, 4};
    const SessionState before = initialState(context, kStart);
    const auto upright = [&](const SessionState& state) {
        return applied(state, SetSize{{360, 640}}).settings.camera;
    };
    EXPECT_EQ(upright(before), settings::overview({{1, 2, 3}, 4}, 360.0 / 640));
    SessionState moved = before;
    moved.settings.camera.eye_world.x += 1;
    EXPECT_EQ(upright(moved), moved.settings.camera);
}

TEST_F(State, Initial_TinyScene_IsBeyondTheNearPlane) {
    context.scene.cameras.clear();
    context.first_view = {};
    context.first_view.sphere_world = {{0, 0, 0}, 0.0017};
    const settings::Camera camera = initialState(context, kStart).settings.camera;
    EXPECT_LT(camera.near_m, 0.5 * camera.focus_m);
}

TEST_F(State, SetCamera_KeepsTheProjectionUnlessTold) {
    SetCamera command{{1, 2, 3}, {1, 2, 0}, {0, 1, 0}, {}, {}, {}};
    const SessionState moved = applied(initial, command);
    EXPECT_EQ(moved.settings.camera.eye_world, glm::dvec3(1, 2, 3));
    EXPECT_DOUBLE_EQ(moved.settings.camera.focus_m, 3);
    EXPECT_EQ(moved.settings.camera.yfov_rad, initial.settings.camera.yfov_rad);

    command.half_height_m = 4;
    const SessionState ortho = applied(moved, command);
    EXPECT_EQ(ortho.settings.camera.projection, settings::Projection::kOrthographic);
    EXPECT_EQ(ortho.settings.camera.half_height_m, 4);

    command.half_height_m.reset();
    command.lens_shift = {0.5, -1};
    const SessionState shifted = applied(ortho, command);
    EXPECT_EQ(shifted.settings.camera.lens_shift, glm::dvec2(0.5, -1));
    command.lens_shift.reset();
    EXPECT_EQ(applied(shifted, command).settings.camera.lens_shift, glm::dvec2(0.5, -1));
    EXPECT_EQ(applied(ortho, command).settings.camera.projection,
              settings::Projection::kOrthographic);
    command.yfov_rad = 1.0;
    const SessionState perspective = applied(ortho, command);
    EXPECT_EQ(perspective.settings.camera.projection, settings::Projection::kPerspective);
    EXPECT_EQ(perspective.settings.camera.yfov_rad, 1.0);
}

TEST_F(State, SelectSceneCamera_TakesPoseAndProjection) {
    const SessionState state = applied(initial, SelectSceneCamera{"plan"});
    EXPECT_EQ(state.settings.camera, context.scene.cameras[1].camera);
}

TEST_F(State, SelectSceneCamera_Unknown_NamesWhatThereIs) {
    const auto result = apply(initial, {{9, 0}, SelectSceneCamera{"na\nve"}}, context, kStart);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, RejectCode::kOutOfRange);
    EXPECT_EQ(result.error().ref_seq, 9U);
    EXPECT_EQ(result.error().field, "name");
    EXPECT_EQ(result.error().message,
              "name \"na\\x0ave\" is not a camera of this scene; it has nave, plan");
    context.scene.cameras.clear();
    EXPECT_THAT(
        apply(initial, {{9, 0}, SelectSceneCamera{"nave"}}, context, kStart).error().message,
        HasSubstr("it has none"));
}

TEST_F(State, SetLights_ChangesOnlyWhatIsGiven) {
    const SessionState state = applied(initial, lights({{"lights", 7U}, {"ambient", 0.25}}));
    EXPECT_EQ(state.settings.lights.count, 7U);
    EXPECT_EQ(state.settings.lights.ambient, 0.25F);
    EXPECT_EQ(state.settings.lights.radius_m, initial.settings.lights.radius_m);
    EXPECT_EQ(state.settings.lights.seed, initial.settings.lights.seed);
    EXPECT_EQ(state.settings.lights.animate, initial.settings.lights.animate);
}

TEST_F(State, SetLights_BoxIsSetAndCleared) {
    BoundsD3 box;
    box.add(glm::dvec3(-1));
    box.add(glm::dvec3(1));
    SetLights command;
    command.box = box;
    const SessionState boxed = applied(initial, command);
    EXPECT_EQ(boxed.settings.lights.box, box);
    command = {};
    command.clear_box = true;
    const SessionState cleared = applied(boxed, command);
    EXPECT_FALSE(cleared.settings.lights.box);
}

TEST_F(State, LightClock_PausesResumesAndChangesSpeedWithoutJumps) {
    const auto animate = [](bool on) { return lights({{"animate", on}}); };
    const auto speed = [](double value) { return lights({{"light_speed", value}}); };
    SessionState state = applied(initial, animate(false), kStart + 10s);
    EXPECT_FALSE(state.animatingAt(kStart));
    EXPECT_DOUBLE_EQ(state.light_clock.secondsAt(kStart + 99s), 10);
    state = applied(state, animate(true), kStart + 100s);
    EXPECT_DOUBLE_EQ(state.light_clock.secondsAt(kStart + 105s), 15);
    state = applied(state, speed(2), kStart + 105s);
    EXPECT_DOUBLE_EQ(state.light_clock.secondsAt(kStart + 105s), 15);
    EXPECT_DOUBLE_EQ(state.light_clock.secondsAt(kStart + 110s), 25);
    state = applied(state, lights({{"lights", 5U}}), kStart + 110s);
    EXPECT_DOUBLE_EQ(state.light_clock.secondsAt(kStart + 111s), 27);
    EXPECT_FALSE(applied(state, lights({{"lights", 0U}})).animatingAt(kStart));
    EXPECT_FALSE(applied(state, speed(0)).animatingAt(kStart));
}

TEST_F(State, LightClock_TimeGiven_IsTakenWhetherItStandsOrRuns) {
    SetLights at_three;
    at_three.time_s = 3.0;
    const SessionState running = applied(initial, at_three, kStart + 10s);
    EXPECT_DOUBLE_EQ(running.light_clock.secondsAt(kStart + 11s), 4);
    EXPECT_FALSE(running.light_clock.stoppedAt());
    SetLights stop = lights({{"animate", false}});
    stop.time_s = 3.0;
    const SessionState stopped = applied(initial, stop, kStart + 10s);
    EXPECT_EQ(stopped.light_clock.stoppedAt(), 3.0);
    EXPECT_EQ(applied(stopped, at_three, kStart + 20s).version, stopped.version);
    SetLights at_five;
    at_five.time_s = 5.0;
    const SessionState moved = applied(stopped, at_five);
    EXPECT_EQ(moved.version, stopped.version + 1) << "it looks different";
}

TEST_F(State, SetGrid_ASizeTurnsAutomaticOff_TrueTurnsItOn) {
    EXPECT_TRUE(initial.settings.grid.automatic);
    SessionState state = applied(initial, gridOf({2, 3, 4}));
    EXPECT_FALSE(state.settings.grid.automatic);
    const SetGrid law{{changes({{"grid_law", chosen(settings::GridLaw::kHyperbolic)}})}, {}, {}};
    state = applied(state, law);
    EXPECT_FALSE(state.settings.grid.automatic);
    EXPECT_EQ(state.settings.grid.law, settings::GridLaw::kHyperbolic);
    SetGrid automatic;
    automatic.automatic = true;
    state = applied(state, automatic);
    EXPECT_TRUE(state.settings.grid.automatic);
    EXPECT_EQ(state.settings.grid.size, (settings::GridSize{2, 3, 4})) << "to go back to";
    automatic.automatic = false;
    state = applied(state, automatic);
    EXPECT_EQ(state.settings.grid,
              (settings::Grid{false, {2, 3, 4}, settings::GridLaw::kHyperbolic}));
}

TEST_F(State, PickLight_PlacesWhatIsThere_UnlessNothingIs) {
    context.pick_light = [](const auto&, double, const auto&, const glm::dvec2& at) {
        settings::PlacedLight light;
        light.position_world = {at.x, at.y, 4};
        light.replaces = settings::LightRef{settings::LightRef::Of::kSeed, 11};
        return light;
    };
    const SessionState state = applied(initial, PickLight{3, {0.5, -0.25}});
    const settings::PlacedLight* light = state.settings.lights.placed.find(3);
    ASSERT_NE(light, nullptr);
    EXPECT_EQ(light->position_world, glm::dvec3(0.5, -0.25, 4));
    EXPECT_EQ(light->replaces->index, 11U);
    context.pick_light = pickNone;
    const auto none = apply(state, {{9, 90}, PickLight{4, {}}}, context, kStart);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "x hits no light");
}

TEST_F(State, TheOtherCommands_SetTheirFields) {
    settings::ToonRamp ramp;
    ramp.count = 2;
    SetToon toon{{changes({{"outline_strength", 0.5}})}, ramp, {}};
    SessionState state = applied(initial, gridOf({15, 15, 15}));
    state = applied(state, toon);
    state = applied(state, SetSize{{17, 4096}});
    EXPECT_EQ(state.settings.grid.size, (settings::GridSize{15, 15, 15}));
    EXPECT_EQ(state.settings.toon_fragment, ramp);
    EXPECT_EQ(state.settings.toon_compute, initial.settings.toon_compute);
    EXPECT_EQ(state.settings.toon_outline.strength, 0.5F);
    EXPECT_EQ(state.settings.size, (settings::Size{17, 4096}));
    EXPECT_EQ(state.version, initial.version + 3);
}

TEST_F(State, Settings_AreSetTogetherAndOneByOne) {
    const SessionState both = applied(
        initial, settings({{"fog_density", 0.5}, {"fog_albedo", glm::dvec3(0.5, 0.25, 1)}}));
    SessionState one = applied(initial, settings({{"fog_density", 0.5}}));
    one = applied(one, settings({{"fog_albedo", glm::dvec3(0.5, 0.25, 1)}}));
    EXPECT_EQ(one.settings, both.settings);
    EXPECT_EQ(one.version, both.version + 1);
    EXPECT_EQ(both.settings.fog.density, 0.5F);
    EXPECT_EQ(both.settings.fog.albedo, glm::vec3(0.5F, 0.25F, 1));
}

TEST_F(State, DebugView_Freeze_KeepsTheCameraOfThen) {
    const SetDebugView set{{changes({{"debug_view", chosen(settings::DebugView::kClusterWires)},
                                     {"debug_scale_max", 12.0}})},
                           {}};
    SessionState state = applied(initial, set);
    EXPECT_EQ(state.settings.debug.view, settings::DebugView::kClusterWires);
    EXPECT_EQ(state.settings.debug.scale_max, 12);
    EXPECT_FALSE(state.settings.debug.grid_camera);
    SetDebugView freeze;
    freeze.freeze = true;
    state = applied(state, freeze);
    const settings::Camera kept = state.settings.camera;
    SetCamera camera;
    camera.target_world = {1, 2, 3};
    state = applied(state, camera);
    EXPECT_NE(state.settings.camera, kept);
    state = applied(state, freeze); // it is frozen already
    EXPECT_EQ(state.settings.debug.grid_camera, kept);
    EXPECT_EQ(state.settings.debug.view, settings::DebugView::kClusterWires);
    freeze.freeze = false;
    EXPECT_FALSE(applied(state, freeze).settings.debug.grid_camera);
}

TEST_F(State, Codec_OnlyOneThatTheClientDecodes) {
    const SetSettings video =
        settings({{"codec", chosen(settings::Codec::kVp9)}, {"video_kbps", 1234U}});
    const auto refused = apply(initial, {{3, 0}, video}, context, kStart);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kUnsupported);
    EXPECT_EQ(refused.error().ref_seq, 3U);
    EXPECT_EQ(refused.error().field, "codec");
    initial.decodable.set();
    const SessionState state = applied(initial, video);
    EXPECT_EQ(state.encoding.codec, settings::Codec::kVp9);
    EXPECT_EQ(state.encoding.video_kbps, 1234U);
    EXPECT_EQ(state.version, initial.version + 1);
    const SetSettings jpeg = settings({{"codec", chosen(settings::Codec::kJpeg)}});
    EXPECT_EQ(applied(state, jpeg).encoding.codec, settings::Codec::kJpeg);
}

TEST_F(State, TooLargeAPicture_IsRefused) {
    EXPECT_TRUE(apply(initial, {{1, 0}, SetSize{{4096, 4096}}}, context, kStart));
    context.defaults.max_area_px = 1'000'000;
    EXPECT_TRUE(apply(initial, {{1, 0}, SetSize{{1000, 1000}}}, context, kStart));
    const auto result = apply(initial, {{3, 0}, SetSize{{1001, 1000}}}, context, kStart);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().ref_seq, 3U);
    EXPECT_EQ(result.error().code, RejectCode::kCapacity);
    EXPECT_EQ(result.error().message,
              "width x height is 1001x1000; this server draws at most 1000000 pixels");
}

TEST_F(State, SamplesOfAPixel_CountAsPixels) {
    context.defaults.max_area_px = 1'000'000;
    const SetSettings smooth = settings({{"antialiasing", chosen(settings::Antialiasing::kSsaa4)}});
    const SessionState small = applied(initial, SetSize{{500, 500}});
    const SessionState smoothed = applied(small, smooth);
    EXPECT_EQ(smoothed.settings.antialiasing, settings::Antialiasing::kSsaa4);
    const auto larger = apply(smoothed, {{3, 0}, SetSize{{501, 500}}}, context, kStart);
    ASSERT_FALSE(larger);
    EXPECT_EQ(larger.error().field, "width");
    EXPECT_EQ(larger.error().message, "width x height is 501x500 with 4 samples a pixel; this "
                                      "server draws at most 1000000 pixels");
    const SessionState large = applied(initial, SetSize{{1000, 1000}});
    const auto refused = apply(large, {{4, 0}, smooth}, context, kStart);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "antialiasing");
}

TEST_F(State, SameValueAgain_CountsAsAppliedNotAsChanged) {
    const SessionState once = applied(initial, gridOf({8, 8, 8}));
    const SessionState twice = applied(once, gridOf({8, 8, 8}));
    EXPECT_EQ(once.version, initial.version + 1);
    EXPECT_EQ(twice.version, once.version);
    EXPECT_EQ(twice.applied, (CommandStamp{2, 20}));
}

TEST_F(State, SameCommands_GiveTheSameState) {
    const auto play = [&] {
        SessionState state = initial;
        state = apply(state, {{1, 0}, gridOf({3, 3, 3})}, context, kStart + 1s).value();
        return apply(state, {{2, 0}, lights({{"light_speed", 0.5}})}, context, kStart + 2s).value();
    };
    EXPECT_EQ(play().settings, play().settings);
    EXPECT_EQ(play().light_clock.secondsAt(kStart + 9s), play().light_clock.secondsAt(kStart + 9s));
}

TEST(Apply, SetDelivery_ChangesThatAlone) {
    const SessionContext context = makeContext();
    const SessionState before = initialState(context, kStart);
    const SetSettings command =
        settings({{"target_fps", 20.0}, {"refine", chosen(settings::Refine::kLossless)}});
    const SessionState after = apply(before, {{1, 0}, command}, context, kStart).value();
    EXPECT_EQ(after.delivery, (DeliverySettings{true, 20.0, settings::Refine::kLossless}));
    EXPECT_EQ(after.settings, before.settings);
    EXPECT_EQ(after.encoding, before.encoding);
    EXPECT_GT(after.version, before.version);
    EXPECT_EQ(apply(after, {{2, 0}, command}, context, kStart).value().version, after.version);
}

TEST(SetsState, ConnectionCommands_DoNot) {
    EXPECT_FALSE(setsState(Hello{}));
    EXPECT_FALSE(setsState(Ack{}));
    EXPECT_FALSE(setsState(Ping{}));
    EXPECT_FALSE(setsState(RequestKeyFrame{}));
    EXPECT_FALSE(setsState(RequestControl{}));
    EXPECT_FALSE(setsState(ReleaseControl{}));
    EXPECT_FALSE(setsState(GiveControl{}));
    EXPECT_FALSE(setsState(Pause{}));
    EXPECT_TRUE(setsState(SetSize{}));
    EXPECT_TRUE(setsState(SetCamera{}));
}

} // namespace
} // namespace froxel::session
