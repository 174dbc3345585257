// What the built-in scripts say, as a server hears it.
#include "load/orbit_script.h"
#include "load/script.h"
#include "scene/motion.h"
#include "session/command_decode.h"
#include "session/state_message.h"
#include "settings/ranges.h"
#include "unit/session/context.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/reflection.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <map>
#include <set>
#include <string>

namespace froxel::load {
namespace {

using namespace std::chrono_literals;

v1::Welcome welcome() {
    v1::Welcome message;
    v1::ViewState& state = *message.mutable_state();
    state.mutable_eye()->set_x(3);
    state.mutable_eye()->set_y(2);
    state.mutable_eye()->set_z(4);
    state.mutable_target()->set_y(1);
    state.mutable_up()->set_y(1);
    state.set_width(640);
    state.set_height(360);
    state.set_light_count(1000);
    state.set_light_radius_m(2);
    message.mutable_scene()->add_cameras("Nave");
    return message;
}

session::CommandResult<session::CommandMessage> heard(v1::ClientMessage message) {
    message.set_seq(1);
    const std::string bytes = message.SerializeAsString();
    return session::decodeCommand(protocol::bytesOf(bytes), protocol::WireFormat::kBinary);
}

TEST(Scripts, Idle_SaysNothing) {
    EXPECT_FALSE(makeScript(Idle{}, welcome(), 1)->next());
}

TEST(Scripts, Orbit_KeepsDistanceAndHeight_SixtyTimesASecond) {
    const auto script = makeScript(Orbit{}, welcome(), 1);
    double last_x = NAN;
    for (int index = 0; index < 600; ++index) {
        const auto step = script->next();
        ASSERT_TRUE(step);
        EXPECT_NEAR(Seconds(step->at).count(), index / 60.0, 1e-6);
        const auto command = heard(step->message);
        ASSERT_TRUE(command) << command.error().message;
        const auto& camera = std::get<session::SetCamera>(command->body);
        EXPECT_NEAR(std::hypot(camera.eye_world.x, camera.eye_world.z), 5, 1e-9);
        EXPECT_EQ(camera.eye_world.y, 2);
        EXPECT_NE(camera.eye_world.x, last_x);
        last_x = camera.eye_world.x;
    }
}

TEST(Scripts, Orbit_OfTwoViewers_LooksFromTwoSides) {
    const auto first = makeScript(Orbit{}, welcome(), 1)->next();
    const auto second = makeScript(Orbit{}, welcome(), 2)->next();
    EXPECT_GT(
        std::abs(first->message.set_camera().eye().x() - second->message.set_camera().eye().x()),
        0.1);
}

Path walk(bool loop = false) {
    const auto key = [](double at_s, double x) {
        return path::Key{at_s, settings::lookAt({x, 1, 0}, {x, 1, -5}, {0, 1, 0})};
    };
    return std::make_shared<const path::CameraPath>(
        path::PathKeys{.keys = {key(0, 0), key(2, 4)}, .seconds = loop ? 4.0 : 2.0, .loop = loop});
}

TEST(Scripts, Path_IsFollowedAgainAndAgain) {
    const auto script = makeScript(walk(), welcome(), 1);
    for (int i = 0; i < 300; ++i) {
        const auto step = script->next();
        ASSERT_TRUE(step);
        EXPECT_NEAR(Seconds(step->at).count(), i / 60.0, 1e-6);
        const auto& camera = step->message.set_camera();
        EXPECT_NEAR(camera.eye().x(), 2 * std::fmod(i / 60.0, 2.0), 1e-6) << i;
        EXPECT_NEAR(camera.target().z(), -5, 1e-9);
        EXPECT_NEAR(camera.fov_deg(), 45, 1e-9);
    }
}

TEST(Scripts, Path_OfTwoViewers_BeginsAtTwoPoints) {
    const auto first = makeScript(walk(true), welcome(), 1)->next();
    const auto second = makeScript(walk(true), welcome(), 2)->next();
    EXPECT_GT(
        std::abs(first->message.set_camera().eye().x() - second->message.set_camera().eye().x()),
        1);
}

TEST(Scripts, PathThatTakesNoTime_IsOneCommand) {
    const Path one = std::make_shared<const path::CameraPath>(
        path::PathKeys{.keys = {{0, settings::lookAt({1, 2, 3}, {0, 0, 0}, {0, 1, 0})}}});
    const auto script = makeScript(one, welcome(), 3);
    EXPECT_TRUE(script->next());
    EXPECT_FALSE(script->next());
    EXPECT_FALSE(isRestless(one, {}));
    EXPECT_TRUE(isRestless(walk(), {}));
}

TEST(Scripts, Orbit_WithTimeToThink_RestsAfterEachCircle) {
    const auto plain = makeScript(Orbit{}, welcome(), 1);
    const auto thinking = makeScript(Orbit{}, welcome(), 1, ThinkTime{2s, 4s});
    Clock::duration rested{};
    std::set<Clock::duration> rests;
    for (int index = 0; index < 3 * 600; ++index) {
        const auto step = thinking->next();
        const auto same = plain->next();
        ASSERT_TRUE(step && same);
        EXPECT_EQ(step->message.SerializeAsString(), same->message.SerializeAsString());
        const auto more = step->at - same->at - rested;
        rested += more;
        EXPECT_EQ(more != Clock::duration{}, index > 0 && index % 600 == 0) << index;
        if (more != Clock::duration{}) {
            EXPECT_GE(more, 2s);
            EXPECT_LE(more, 4s);
            rests.insert(more);
        }
    }
    EXPECT_EQ(rests.size(), 2U) << "each of its own length";
}

TEST(Scripts, Recording_WithTimeToThink_IsPlayedAgain) {
    auto steps = std::make_shared<std::vector<Step>>(2);
    steps->at(0).message.mutable_ping();
    steps->at(1).at = 1s;
    const auto once = makeScript(Recording(steps), welcome(), 1);
    EXPECT_TRUE(once->next() && once->next() && !once->next());
    const auto again = makeScript(Recording(steps), welcome(), 1, ThinkTime{3s, 3s});
    std::vector<Clock::duration> times;
    for (int index = 0; index < 5; ++index) {
        times.push_back(again->next().value().at);
    }
    EXPECT_EQ(times, (std::vector<Clock::duration>{0s, 1s, 4s, 5s, 8s}));
    EXPECT_FALSE(
        makeScript(std::make_shared<std::vector<Step>>(), welcome(), 1, ThinkTime{3s, 3s})->next())
        << "an empty one is over";
}

TEST(Scripts, Restless_AreThoseThatNeverPause) {
    EXPECT_TRUE(isRestless(Orbit{}, {}));
    EXPECT_TRUE(isRestless(Storm{}, {}));
    EXPECT_FALSE(isRestless(Idle{}, {}));
    EXPECT_FALSE(isRestless(Orbit{}, ThinkTime{1s, 1s}));
}

// Paths of all fields that a message has, of messages within it too.
void listFields(const google::protobuf::Descriptor& message,
                const std::string& path,
                std::set<std::string>& paths) {
    for (int index = 0; index < message.field_count(); ++index) {
        const auto& field = *message.field(index);
        const std::string name = path + field.name();
        if (field.cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) {
            listFields(*field.message_type(), name + ".", paths);
        } else {
            paths.insert(name);
        }
    }
}

// Of those that are set to anything but their default.
void noteFields(const google::protobuf::Message& message,
                const std::string& path,
                std::set<std::string>& paths) {
    std::vector<const google::protobuf::FieldDescriptor*> fields;
    const auto& reflection = *message.GetReflection();
    reflection.ListFields(message, &fields);
    for (const auto* field : fields) {
        const std::string name = path + field->name();
        if (field->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) {
            paths.insert(name);
        } else if (!field->is_repeated()) {
            noteFields(reflection.GetMessage(message, field), name + ".", paths);
        } else {
            for (const auto& one :
                 reflection.GetRepeatedFieldRef<google::protobuf::Message>(message, field)) {
                noteFields(one, name + ".", paths);
            }
        }
    }
}

TEST(Scripts, Storm_SaysEverySetting_AllAccepted) {
    session::SessionContext context = session::makeContext();
    scene::Motion motion;
    motion.clips = {{"walk", 2, {}, {}}, {"run", 0.5, {}, {}}};
    context.scene.motion = std::make_shared<const scene::Motion>(std::move(motion));
    session::SessionState state = session::initialState(context, TimePoint(1s));
    state.decodable.set(static_cast<size_t>(settings::Codec::kVp9));
    const auto script = makeScript(Storm{}, session::makeWelcome(1, context, state).welcome(), 3);
    std::set<std::string> said;
    std::map<uint32_t, int> widths;
    for (int index = 0; index < 20'000; ++index) {
        const auto step = script->next();
        ASSERT_TRUE(step);
        EXPECT_NEAR(Seconds(step->at).count(), index / 200.0, 1e-6);
        const auto command = heard(step->message);
        ASSERT_TRUE(command) << step->message.ShortDebugString() << ": " << command.error().message;
        if (session::setsState(command->body)) {
            auto applied = session::apply(state, *command, context, TimePoint(1s) + step->at);
            ASSERT_TRUE(applied || applied.error().code == session::RejectCode::kCapacity)
                << step->message.ShortDebugString() << ": " << applied.error().message;
            state = applied ? std::move(*applied) : state;
        }
        noteFields(step->message, "", said);
        ++widths[step->message.set_size().width()];
    }
    EXPECT_GT(widths[settings::kWidthRange.min], 100);
    EXPECT_GT(widths[settings::kWidthRange.max], 100);
    EXPECT_GT(widths.size(), 100U);

    std::set<std::string> all;
    listFields(*v1::ClientMessage::descriptor(), "", all);
    std::erase_if(all, [&](const std::string& field) { return said.contains(field); });
    // What the viewer says itself, what is about rooms and pausing, and what is refused where there
    // is no such light or scene.
    const auto others =
        testing::MatchesRegex("(seq|client_time_us|ack.*|hello.*|give_control.*|"
                              "pause.*|request_depth.*|pick_light.*|select_scene.scene|"
                              "set_placed_lights.remove)");
    EXPECT_THAT(all, testing::Each(others));
}

TEST(Scripts, Storm_IsTheSameInEveryRun) {
    const auto first = makeScript(Storm{}, welcome(), 2);
    const auto again = makeScript(Storm{}, welcome(), 2);
    for (int index = 0; index < 100; ++index) {
        EXPECT_EQ(first->next()->message.SerializeAsString(),
                  again->next()->message.SerializeAsString());
    }
}

TEST(Scripts, Recording_IsPlayedOnceByEveryViewer) {
    auto steps = std::make_shared<std::vector<Step>>(2);
    (*steps)[1].message.mutable_ping();
    for (const uint32_t viewer : {1U, 2U}) {
        const auto script = makeScript(Recording(steps), welcome(), viewer);
        EXPECT_FALSE(script->next()->message.has_ping());
        EXPECT_TRUE(script->next()->message.has_ping());
        EXPECT_FALSE(script->next());
    }
}

// Every fourth selection or so is called off by the one before it, soon.
TEST(SceneScript, GoesOver_AndCallsOff_TwoAndTwoAlike) {
    const std::vector<std::string> ids{"a", "b", "c"};
    const auto first = makeScript(Scenes{ids}, welcome(), 1);
    const auto second = makeScript(Scenes{ids}, welcome(), 2);
    std::set<std::string> seen;
    int called_off = 0;
    std::optional<Step> before;
    std::string shown;
    for (int i = 0; i < 100; ++i) {
        const auto step = first->next();
        ASSERT_TRUE(step);
        const std::string scene = step->message.select_scene().scene();
        EXPECT_EQ(scene, second->next()->message.select_scene().scene());
        if (before && step->at - before->at < 1s) {
            ++called_off;
            EXPECT_EQ(scene, shown) << "the one that was there";
        } else if (before) {
            EXPECT_GE(step->at - before->at, 1999ms);
        }
        if (before) {
            shown = before->message.select_scene().scene();
            EXPECT_NE(scene, shown) << "which changes nothing";
        }
        seen.insert(scene);
        before = step;
        EXPECT_TRUE(scene.empty() || heard(step->message));
    }
    EXPECT_GT(called_off, 10);
    EXPECT_LT(called_off, 40);
    EXPECT_GE(seen.size(), 3U);
}

} // namespace
} // namespace froxel::load
