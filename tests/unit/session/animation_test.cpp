// The scene's animations under a viewer's command.
#include "froxel/v1/server.pb.h"
#include "scene/motion.h"
#include "session/state_message.h"
#include "session/view_state.h"
#include "support/settings.h"
#include "unit/session/messages.h"
#include "unit/session/state_fixture.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;
using test::changes;
using test::chosen;

// Two animations, of 2 s and of 0.5 s; the first moves camera "plan" by 4 along x.
std::shared_ptr<const scene::Motion> twoAnimations() {
    scene::Motion motion;
    motion.nodes.resize(1);
    motion.cameras = {{1, 0}};
    scene::Track track{scene::Interpolation::kLinear, 3, {0, 2}, {0, 30, 0, 4, 30, 0}};
    motion.clips = {{"walk", 2, {track}, {{0, 0, scene::ChannelPath::kTranslation}}},
                    {"", 0.5, {}, {}}};
    return std::make_shared<const scene::Motion>(std::move(motion));
}

class Animation : public State {
  protected:
    Animation() {
        context.scene.motion = twoAnimations();
        context.defaults.settings.lights.count = 0;
        initial = initialState(context, kStart);
    }
    std::string refusalOf(const SetAnimation& command) {
        const auto result = apply(initial, {{9, 0}, command}, context, kStart);
        EXPECT_FALSE(result);
        return result ? "" : result.error().message;
    }
    static SetAnimation
    with(std::initializer_list<std::pair<std::string_view, settings::SettingValue>> values) {
        return {{changes(values)}};
    }
    static SetAnimation chosenAs(uint32_t number) {
        SetAnimation command;
        command.number = number;
        return command;
    }
    static SetAnimation seek(double time_s) {
        SetAnimation command;
        command.time_s = time_s;
        return command;
    }
    static double timeOf(const SessionState& state, TimePoint now) {
        return state.playback.timeAt(SessionState::secondsOf(now)).value_or(-1);
    }
};

TEST_F(Animation, Initial_PlaysTheOneThatTheSceneNames) {
    EXPECT_EQ(initial.settings.animation.number, 1U);
    EXPECT_EQ(timeOf(initial, kStart), 0);
    EXPECT_EQ(timeOf(initial, kStart + 2500ms), 0.5);
    EXPECT_TRUE(initial.animatingAt(kStart)) << "without lights";
    scene::Motion none = *context.scene.motion;
    none.played = scene::kNone;
    context.scene.motion = std::make_shared<const scene::Motion>(none);
    EXPECT_EQ(initialState(context, kStart).settings.animation.number, 0U);
    EXPECT_FALSE(initialState(context, kStart).animatingAt(kStart));
}

TEST_F(Animation, Paused_IsAtRest_WhateverTheLightsClockDoes) {
    const SessionState paused =
        applied(initial, with({{"animation_playing", false}}), kStart + 1250ms);
    EXPECT_TRUE(paused.light_clock.moving());
    EXPECT_FALSE(paused.animatingAt(kStart + 9s));
    EXPECT_EQ(timeOf(paused, kStart + 9s), 1.25);
    EXPECT_GT(paused.version, initial.version);
    const SessionState sought = applied(paused, seek(0.75), kStart + 9s);
    EXPECT_EQ(timeOf(sought, kStart + 10s), 0.75);
    EXPECT_GT(sought.version, paused.version);
    EXPECT_EQ(applied(sought, seek(0.75), kStart + 9s).version, sought.version);
}

TEST_F(Animation, Once_IsAtRestAfterItsEnd) {
    const SessionState once =
        applied(initial, with({{"animation_repeat", chosen(settings::Repeat::kOnce)}}));
    EXPECT_TRUE(once.animatingAt(kStart + 1999ms));
    EXPECT_FALSE(once.animatingAt(kStart + 2s));
}

TEST_F(Animation, Another_BeginsAndFades) {
    SessionState state = applied(initial, with({{"animation_fade", 4.0}}));
    state = applied(state, chosenAs(2), kStart + 1s);
    EXPECT_EQ(timeOf(state, kStart + 1250ms), 0.25);
    const auto playing = state.playback.at(SessionState::secondsOf(kStart + 3s));
    ASSERT_EQ(playing->clips.size(), 2U);
    EXPECT_EQ(playing->clips[1].fade.weightAt(playing->now_s), 0.5);
    EXPECT_EQ(applied(state, chosenAs(2), kStart + 2s).version, state.version);
}

TEST_F(Animation, TimeBeyondTheEnd_GoesOnAsItRepeats) {
    const SessionState paused = applied(initial, with({{"animation_playing", false}}));
    const auto at = [&](settings::Repeat repeat) {
        const SessionState state =
            applied(paused, with({{"animation_repeat", chosen(repeat)}}), kStart);
        return timeOf(applied(state, seek(2.5), kStart), kStart + 9s);
    };
    EXPECT_EQ(at(settings::Repeat::kLoop), 0.5);
    EXPECT_EQ(at(settings::Repeat::kPingPong), 1.5);
    EXPECT_EQ(at(settings::Repeat::kOnce), 2);
}

TEST_F(Animation, Unknown_IsRefusedWithThoseThatThereAre) {
    EXPECT_EQ(refusalOf(chosenAs(3)), "animation is 3; this scene has 1 walk, 2 (nameless)");
    initial = applied(initial, chosenAs(0));
    EXPECT_EQ(refusalOf(seek(0)), "animation_time is 0; no animation is selected");
    context.scene.motion = nullptr;
    EXPECT_EQ(refusalOf(chosenAs(1)), "animation is 1; this scene has none");
}

TEST_F(Animation, SceneThatRests_HasNothingOfIt) {
    context.scene.motion = nullptr;
    const SessionState rests = initialState(context, kStart);
    EXPECT_EQ(rests.playback.at(3), std::nullopt);
    EXPECT_FALSE(rests.animatingAt(kStart));
    const SessionState faster = applied(rests, with({{"animation_speed", 2.0}}));
    EXPECT_EQ(faster.playback, rests.playback);
    EXPECT_EQ(makeWelcome(1, context, rests).welcome().scene().animations_size(), 0);
}

TEST_F(Animation, CameraThatMoves_IsFollowedUntilItIsSteered) {
    EXPECT_FALSE(initial.followed) << "the first one rests";
    const SessionState state = applied(initial, SelectSceneCamera{"plan"});
    EXPECT_EQ(state.followed, 1U);
    EXPECT_EQ(state.cameraAt(kStart).eye_world, glm::dvec3(0, 30, 0));
    EXPECT_EQ(state.cameraAt(kStart + 500ms).eye_world, glm::dvec3(1, 30, 0));
    EXPECT_EQ(state.cameraAt(kStart).half_height_m, 12) << "its projection stays";
    const SessionState steered =
        applied(state, SetCamera{{1, 2, 3}, {1, 2, 0}, {0, 1, 0}, {}, {}, {}});
    EXPECT_FALSE(steered.followed);
    EXPECT_EQ(steered.cameraAt(kStart + 1s), steered.settings.camera);
    EXPECT_FALSE(applied(state, SelectSceneCamera{"nave"}).followed);
}

TEST_F(Animation, FirstCameraThatMoves_IsFollowedFromTheBeginning) {
    scene::Motion motion = *context.scene.motion;
    motion.cameras = {{0, 0}};
    context.scene.motion = std::make_shared<const scene::Motion>(motion);
    EXPECT_EQ(initialState(context, kStart).followed, 0U);
    context.first_view.scene_camera.reset();
    EXPECT_FALSE(initialState(context, kStart).followed);
}

TEST_F(Animation, PickedLight_IsThatOfThePicture) {
    const SessionState state = applied(initial, SelectSceneCamera{"plan"});
    context.pick_light = [](const settings::ViewSettings& settings, double,
                            const std::optional<motion::Playing>& playing, const glm::dvec2&) {
        settings::PlacedLight light;
        light.position_world = {settings.camera.eye_world.x, playing->now_s, 0};
        return light;
    };
    const SessionState picked = applied(state, PickLight{3, {}}, kStart + 1s);
    EXPECT_EQ(picked.settings.lights.placed.find(3)->position_world, glm::dvec3(2, 51, 0));
}

TEST_F(Animation, Messages_TellIt) {
    const auto welcome = makeWelcome(1, context, initial).welcome();
    ASSERT_EQ(welcome.scene().animations_size(), 2);
    EXPECT_EQ(welcome.scene().animations(0).name(), "walk");
    EXPECT_EQ(welcome.scene().animations(1).duration_s(), 0.5);
    EXPECT_EQ(welcome.state().animation(), 1U);
    EXPECT_FALSE(welcome.state().has_animation_time_s());
    EXPECT_EQ(welcome.state().followed_camera(), "");
    SessionState state = applied(initial, SelectSceneCamera{"plan"});
    state = applied(state, with({{"animation_playing", false}}), kStart + 1500ms);
    v1::ViewState told;
    fillViewState(told, context, state);
    EXPECT_EQ(told.animation_time_s(), 1.5);
    EXPECT_EQ(told.followed_camera(), "plan");

    FrameRecord record;
    EXPECT_FALSE(makeFrameHeader(record).has_animation_time_s());
    EXPECT_FALSE(makeFrameHeader(record).has_camera());
    record.animation_time_s = 0.5;
    record.followed = state.cameraAt(kStart);
    const v1::FrameHeader header = makeFrameHeader(record);
    EXPECT_EQ(header.animation_time_s(), 0.5);
    EXPECT_EQ(header.camera().eye().x(), 3);
    EXPECT_EQ(header.camera().eye().y(), 30);
}

TEST(DecodeCommand, SetAnimation_TakesWhatIsThere) {
    v1::ClientMessage message = clientMessage();
    v1::SetAnimation& set = *message.mutable_set_animation();
    EXPECT_FALSE(accepted<SetAnimation>(decodeBinary(message)).number);
    set.set_animation(0);
    set.set_time_s(0);
    set.set_speed(-2);
    const auto command = accepted<SetAnimation>(decodeBinary(message));
    EXPECT_EQ(command.number, 0U);
    EXPECT_EQ(command.time_s, 0.0);
    EXPECT_EQ(test::givenBy<double>(command, "animation_speed"), -2);
    set.set_time_s(-1);
    EXPECT_EQ(refused(decodeBinary(message)).field, "animation_time");
}

} // namespace
} // namespace froxel::session
