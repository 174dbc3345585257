// What the built-in scripts say, as a server hears it.
#include "load/orbit_script.h"
#include "load/script.h"
#include "session/command_decode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace froxel::load {
namespace {

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

TEST(Scripts, Storm_SaysEverySetting_AllAccepted) {
    const auto script = makeScript(Storm{}, welcome(), 3);
    std::set<int> kinds;
    std::set<int> renderers;
    for (int index = 0; index < 5000; ++index) {
        const auto step = script->next();
        ASSERT_TRUE(step);
        EXPECT_NEAR(Seconds(step->at).count(), index / 200.0, 1e-6);
        const auto command = heard(step->message);
        ASSERT_TRUE(command) << step->message.ShortDebugString() << ": " << command.error().message;
        kinds.insert(step->message.body_case());
        renderers.insert(step->message.set_renderer().renderer());
    }
    // All but Hello and Ack, which the viewer says, what is about a room (3), pausing, and picking,
    // which is refused where no light is.
    const int all = v1::ClientMessage::descriptor()->oneof_decl(0)->field_count();
    EXPECT_EQ(static_cast<int>(kinds.size()), all - 7);
    EXPECT_EQ(renderers.size(), 6U) << "five, and none";
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

} // namespace
} // namespace froxel::load
