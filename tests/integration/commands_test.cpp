// What viewers say and what they get for it.
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>

#include <limits>

namespace froxel::test {
namespace {

using protocol::WireFormat;
using v1::ClientMessage;
using v1::ServerMessage;

v1::Vec3 vec3(double x, double y, double z) {
    v1::Vec3 value;
    value.set_x(x);
    value.set_y(y);
    value.set_z(z);
    return value;
}

ClientMessage setSize(uint32_t width, uint32_t height) {
    ClientMessage message;
    message.mutable_set_size()->set_width(width);
    message.mutable_set_size()->set_height(height);
    return message;
}

ClientMessage setExposure(double exposure) {
    ClientMessage message;
    message.mutable_set_exposure()->set_exposure(exposure);
    return message;
}

ClientMessage setRenderer(v1::Renderer renderer) {
    ClientMessage message;
    message.mutable_set_renderer()->set_renderer(renderer);
    return message;
}

class CommandsTest : public testing::Test {
  protected:
    v1::ViewState change(const ClientMessage& message) {
        return client_.expectState(client_.send(message));
    }

    TestServer server_;
    WsClient client_{server_.port()};
};

TEST_F(CommandsTest, Hello_FirstMessage_IsAnsweredByWelcomeAndAPicture) {
    const v1::Welcome welcome = client_.join();
    EXPECT_EQ(welcome.protocol_major(), 1U);
    EXPECT_GT(welcome.session_id(), 0U);
    EXPECT_EQ(welcome.device(), "fake device");
    EXPECT_EQ(welcome.scene().cameras_size(), 2);
    EXPECT_GT(welcome.ranges_size(), 5);
    const Frame frame = client_.expectFrame();
    EXPECT_EQ(frame.header.frame_id(), 1U);
    EXPECT_EQ(frame.header.width(), welcome.state().width());
    ASSERT_GE(frame.jpeg.size(), 3U);
    EXPECT_EQ(frame.jpeg[0], std::byte{0xFF});
    EXPECT_EQ(frame.jpeg[1], std::byte{0xD8});
    EXPECT_GT(frame.header.render_us() + frame.header.encode_us(), 0U);
    EXPECT_EQ(client_.acceptedSubprotocol(), "froxel.v1");
}

TEST_F(CommandsTest, SetCamera_Valid_TurnsUpInTheStateAndInAFrame) {
    client_.join();
    ClientMessage message;
    *message.mutable_set_camera()->mutable_eye() = vec3(1, 2, 3);
    *message.mutable_set_camera()->mutable_target() = vec3(0, 1, 0);
    message.mutable_set_camera()->set_fov_deg(50);
    const uint64_t seq = client_.send(message);
    const v1::ViewState state = client_.expectState(seq);
    EXPECT_DOUBLE_EQ(state.eye().x(), 1);
    EXPECT_NEAR(state.target().y(), 1, 1e-9);
    EXPECT_NEAR(state.fov_deg(), 50, 1e-9);
    const Frame frame =
        client_.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
    EXPECT_EQ(frame.header.applied_client_time_us(), 1000 * seq);
}

TEST_F(CommandsTest, CommandsOfCameraLightsAndGrid_Valid_ChangeTheState) {
    client_.join();
    ClientMessage message;
    message.mutable_select_scene_camera()->set_name("side");
    EXPECT_NEAR(change(message).eye().x(), 5, 1e-9);

    for (const auto renderer :
         {v1::RENDERER_NAIVE, v1::RENDERER_FORWARD_PLUS, v1::RENDERER_TOON_FRAGMENT,
          v1::RENDERER_TOON_COMPUTE, v1::RENDERER_CLUSTERED_DEFERRED}) {
        EXPECT_EQ(change(setRenderer(renderer)).renderer(), renderer);
    }

    auto* lights = message.mutable_set_lights();
    lights->set_count(42);
    lights->set_radius_m(3.5);
    lights->set_intensity(2);
    lights->set_cutoff(0.01);
    lights->set_seed(9);
    lights->set_animate(false);
    lights->set_speed(0.5);
    lights->set_ambient(0.25);
    lights->set_scene_lights(false);
    *lights->mutable_box()->mutable_min() = vec3(-1, -2, -3);
    *lights->mutable_box()->mutable_max() = vec3(1, 2, 3);
    const v1::ViewState lit = change(message);
    EXPECT_EQ(lit.light_count(), 42U);
    EXPECT_DOUBLE_EQ(lit.light_radius_m(), 3.5);
    EXPECT_NEAR(lit.light_cutoff(), 0.01, 1e-9);
    EXPECT_EQ(lit.light_seed(), 9U);
    EXPECT_FALSE(lit.light_animate());
    EXPECT_FALSE(lit.scene_lights());
    EXPECT_DOUBLE_EQ(lit.light_box().max().z(), 3);

    auto* grid = message.mutable_set_grid()->mutable_grid();
    grid->set_x(15);
    grid->set_y(14);
    grid->set_z(13);
    const v1::ViewState gridded = change(message);
    EXPECT_EQ(gridded.grid().y(), 14U);
    EXPECT_FALSE(gridded.grid_automatic());
    message.mutable_set_grid()->clear_grid();
    message.mutable_set_grid()->set_automatic(true);
    message.mutable_set_grid()->set_law(v1::GRID_LAW_LINEAR);
    const v1::ViewState automatic = change(message);
    EXPECT_TRUE(automatic.grid_automatic());
    EXPECT_EQ(automatic.grid_law(), v1::GRID_LAW_LINEAR);
}

TEST_F(CommandsTest, CommandsOfShadingAndEncoding_Valid_ChangeTheState) {
    client_.join();
    ClientMessage message;
    auto* renderer = message.mutable_set_renderer();
    renderer->set_renderer(v1::RENDERER_CLUSTERED_DEFERRED);
    renderer->set_lighting(v1::LIGHTING_STAGE_FRAGMENT);
    renderer->set_shading(v1::SHADING_MODEL_LAMBERT);
    renderer->mutable_gbuffer()->set_normal(v1::NORMAL_ENCODING_OCT8);
    renderer->mutable_gbuffer()->set_position(v1::POSITION_SOURCE_STORED_DEPTH);
    const v1::ViewState shaded = change(message);
    EXPECT_EQ(shaded.shading(), v1::SHADING_MODEL_LAMBERT);
    EXPECT_EQ(shaded.gbuffer().normal(), v1::NORMAL_ENCODING_OCT8);
    EXPECT_EQ(shaded.gbuffer().position(), v1::POSITION_SOURCE_STORED_DEPTH);

    auto* lights = message.mutable_set_lights();
    lights->set_light_loop(v1::LIGHT_LOOP_LISTS);
    lights->set_count_pairs(true);
    lights->set_animate(false);
    lights->set_time_s(12.5);
    const v1::ViewState looped = change(message);
    EXPECT_EQ(looped.light_loop(), v1::LIGHT_LOOP_LISTS);
    EXPECT_TRUE(looped.count_pairs());
    EXPECT_DOUBLE_EQ(looped.light_time_s(), 12.5);

    message.mutable_set_exposure()->set_exposure(2);
    message.mutable_set_exposure()->set_tone_map(v1::TONE_MAP_CLAMP);
    EXPECT_EQ(change(message).tone_map(), v1::TONE_MAP_CLAMP);

    auto* ramp = message.mutable_set_toon()->mutable_fragment();
    ramp->add_points()->set_x(0);
    auto* end = ramp->add_points();
    end->set_x(1);
    end->set_y(0.5);
    EXPECT_EQ(change(message).toon_fragment().points_size(), 2);

    message.mutable_set_encoding()->set_quality(33);
    message.mutable_set_encoding()->set_chroma(v1::CHROMA_444);
    const v1::ViewState encoded = change(message);
    EXPECT_EQ(encoded.quality(), 33U);
    EXPECT_EQ(encoded.chroma(), v1::CHROMA_444);
}

TEST_F(CommandsTest, Ping_Any_IsEchoed) {
    client_.join();
    ClientMessage ping;
    ping.mutable_ping();
    const uint64_t seq = client_.send(ping);
    const auto pong = client_.expect(ServerMessage::kPong).pong();
    EXPECT_EQ(pong.ref_seq(), seq);
    EXPECT_EQ(pong.client_time_us(), 1000 * seq);
}

TEST_F(CommandsTest, SetSize_OddSizes_PicturesHaveThem) {
    client_.join();
    for (const auto& [width, height] :
         {std::pair{33U, 17U}, {16U, 16U}, {1001U, 77U}, {17U, 999U}, {640U, 360U}}) {
        const uint64_t seq = client_.send(setSize(width, height));
        const Frame frame =
            client_.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
        EXPECT_EQ(frame.header.width(), width);
        EXPECT_EQ(frame.header.height(), height);
        ASSERT_EQ(frame.header.parts_size(), 1);
        EXPECT_EQ(frame.header.parts(0).length(), frame.jpeg.size());
    }
}

TEST_F(CommandsTest, SetSize_Storm_LastOneWins) {
    client_.join();
    uint64_t seq = 0;
    for (uint32_t i = 0; i < 200; ++i) {
        seq = client_.send(setSize(16 + i, 316 - i));
    }
    const Frame frame =
        client_.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
    EXPECT_EQ(frame.header.width(), 215U);
    EXPECT_EQ(frame.header.height(), 117U);
}

TEST_F(CommandsTest, SetSize_DoesNotFitTheDevice_FallsBackToTheLastGoodSize) {
    const auto before = client_.join().state();
    client_.expectFrame();
    server_.device().max_area_px = 100'000;
    const uint64_t seq = client_.send(setSize(2000, 2000));
    const v1::Error error = client_.expectError();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_CAPACITY);
    EXPECT_EQ(error.ref_seq(), seq);
    EXPECT_EQ(client_.expectState(seq).width(), before.width());
    const uint64_t next = client_.send(setSize(100, 100));
    client_.expectFrame([&](const auto& header) { return header.applied_seq() >= next; });
}

TEST_F(CommandsTest, DeviceCannot_FallsBackToTheLastGoodState) {
    const auto before = client_.join().state();
    client_.expectFrame();
    server_.device().computes = false;
    ClientMessage message = setRenderer(v1::RENDERER_NAIVE);
    message.mutable_set_renderer()->set_lighting(v1::LIGHTING_STAGE_COMPUTE);
    const uint64_t seq = client_.send(message);
    const v1::Error error = client_.expectError();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_UNSUPPORTED);
    EXPECT_EQ(error.ref_seq(), seq);
    EXPECT_EQ(client_.expectState(seq).renderer(), before.renderer());
    const uint64_t next = client_.send(setExposure(2));
    client_.expectFrame([&](const auto& header) { return header.applied_seq() >= next; });
}

TEST_F(CommandsTest, Details_ComeOnceBeforeTheFirstFrame) {
    client_.join();
    const auto details = client_.expect(ServerMessage::kDetails).details();
    EXPECT_EQ(details.plan_size(), 1);
    EXPECT_EQ(details.memory(0).bytes(), 4096U);
    const Frame frame = client_.expectFrame();
    EXPECT_EQ(frame.header.frame_id(), 1U);
    EXPECT_EQ(frame.header.grid().why(), "a fake");
    EXPECT_EQ(frame.header.list_p95(), 9U);
    EXPECT_FALSE(frame.header.has_pairs());
    ClientMessage count;
    count.mutable_set_lights()->set_count_pairs(true);
    const uint64_t seq = client_.send(count);
    const Frame counted =
        client_.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
    EXPECT_EQ(counted.header.pairs().contributing(), 250U);
}

TEST_F(CommandsTest, BadValues_Any_AreNamedAndChangeNothing) {
    client_.join();
    const auto good = change(setExposure(1.5));
    struct Case {
        ClientMessage message;
        std::string field;
    };
    std::vector<Case> cases = {
        {setExposure(std::numeric_limits<double>::quiet_NaN()), "exposure"},
        {setExposure(std::numeric_limits<double>::infinity()), "exposure"},
        {setExposure(-1), "exposure"},
        {setSize(15, 100), "width"},
        {setSize(100, 4097), "height"},
    };
    ClientMessage lights;
    lights.mutable_set_lights()->set_count(1'000'001);
    cases.push_back({lights, "lights"});
    for (const Case& bad : cases) {
        const uint64_t seq = client_.send(bad.message);
        const v1::Error error = client_.expectError();
        EXPECT_EQ(error.code(), v1::ERROR_CODE_OUT_OF_RANGE) << error.message();
        EXPECT_EQ(error.ref_seq(), seq);
        EXPECT_EQ(error.field(), bad.field) << error.message();
    }
    const auto after = change(setExposure(1.5));
    EXPECT_EQ(after.SerializeAsString(), good.SerializeAsString());
}

TEST_F(CommandsTest, BadMessages_Any_AreAnsweredAndTheConnectionStays) {
    client_.join();
    client_.sendRaw("\xff\xff\xff garbage", WireFormat::kBinary);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_MALFORMED);
    client_.sendRaw("{\"seq\": 99", WireFormat::kText);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_MALFORMED);
    client_.sendRaw("", WireFormat::kBinary);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_MALFORMED);
    client_.ack(1'000'000);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_OUT_OF_RANGE);
    ClientMessage unknown_camera;
    unknown_camera.mutable_select_scene_camera()->set_name("nowhere\n\x1b[31m");
    client_.send(unknown_camera);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_OUT_OF_RANGE);
    EXPECT_DOUBLE_EQ(change(setExposure(3)).exposure(), 3);
}

TEST_F(CommandsTest, BadMessages_TooMany_CloseWithPolicy) {
    client_.join();
    for (int i = 0; i < 30; ++i) {
        client_.sendRaw("\xff", WireFormat::kBinary);
    }
    EXPECT_EQ(client_.expectClosed().code, 1008);
}

TEST_F(CommandsTest, Hello_OtherMajor_ClosesWithVersion) {
    ClientMessage hello;
    hello.mutable_hello()->set_protocol_major(7);
    client_.send(hello);
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_VERSION);
    EXPECT_EQ(client_.expectClosed().code, 4001);
}

TEST_F(CommandsTest, FirstMessage_IsNoHello_IsRefusedAndHelloStillWorks) {
    client_.send(setExposure(2));
    EXPECT_EQ(client_.expectError().code(), v1::ERROR_CODE_MALFORMED);
    client_.join();
}

TEST_F(CommandsTest, Renderers_Switched_PicturesDiffer) {
    client_.join();
    std::vector<std::vector<std::byte>> pictures;
    for (const auto renderer : {v1::RENDERER_NAIVE, v1::RENDERER_TOON_COMPUTE}) {
        const uint64_t seq = client_.send(setRenderer(renderer));
        pictures.push_back(
            client_.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; })
                .jpeg);
    }
    EXPECT_NE(pictures[0], pictures[1]);
}

TEST_F(CommandsTest, TwoSessions_AtOnce_HaveStatesOfTheirOwn) {
    const auto first = client_.join();
    WsClient other(server_.port());
    const auto second = other.join();
    EXPECT_NE(first.session_id(), second.session_id());
    change(setExposure(4));
    const uint64_t seq = other.send(setSize(100, 50));
    EXPECT_DOUBLE_EQ(other.expectState(seq).exposure(), 1);
    const Frame small =
        other.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
    EXPECT_EQ(small.header.width(), 100U);
    EXPECT_EQ(client_.expectFrame().header.width(), 64U);
    other.close();
    EXPECT_GT(client_.expectFrame().header.frame_id(), 0U);
}

TEST(JsonCommands, TextHello_AllAnswersAreTextAndFramesBinary) {
    TestServer server;
    WsClient client(server.port(), {.format = WireFormat::kText});
    client.join();
    const uint64_t seq = client.send(setExposure(2.5));
    EXPECT_DOUBLE_EQ(client.expectState(seq).exposure(), 2.5);
    EXPECT_GT(client.expectFrame().jpeg.size(), 100U);
    client.sendRaw(R"({"seq":"50","setExposure":{"exposure":"NaN"}})", WireFormat::kText);
    EXPECT_EQ(client.expectError().code(), v1::ERROR_CODE_OUT_OF_RANGE);
}

TEST(StillScene, NothingChanges_NothingIsSent) {
    TestServer server({.still = true});
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    EXPECT_TRUE(client.quietFor(std::chrono::milliseconds(300)));
    EXPECT_EQ(server.device().submitted_count, 1U);
    const uint64_t seq = client.send(setExposure(2));
    EXPECT_EQ(client.expectFrame().header.applied_seq(), seq);
    EXPECT_TRUE(client.quietFor(std::chrono::milliseconds(300)));
}

} // namespace
} // namespace froxel::test
