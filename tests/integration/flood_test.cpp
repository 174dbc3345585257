// Who says too much, or it takes too long to read. tests/hostile has the figures.
#include "froxel/v1/client.pb.h"
#include "integration/raw_web_socket.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"
#include "net/read_budget.h"

#include <gtest/gtest.h>

namespace froxel::test {
namespace {

using Raw = RawWebSocket;

constexpr uint32_t kManyLights = 500; // some 40 KB

v1::ClientMessage placeLights(double intensity) {
    v1::ClientMessage message;
    for (uint32_t id = 1; id <= kManyLights; ++id) {
        v1::PlacedLight& light = *message.mutable_set_placed_lights()->add_lights();
        light.set_id(id);
        light.mutable_position()->set_x(id);
        light.set_intensity(intensity);
    }
    return message;
}

v1::ClientMessage setExposure(double exposure) {
    v1::ClientMessage message;
    message.mutable_set_exposure()->set_exposure(exposure);
    return message;
}

// Each refers to what the one before left.
TEST(LongMessages, AmongShortOnes_AreCarriedOutInTheirOrder) {
    for (const auto format : {protocol::WireFormat::kBinary, protocol::WireFormat::kText}) {
        TestServer server;
        WsClient client(server.port(), {.format = format});
        client.join();
        for (int i = 1; i <= 5; ++i) {
            client.send(placeLights(i));
            v1::ClientMessage remove;
            remove.mutable_set_placed_lights()->add_remove(kManyLights);
            client.send(remove); // refused where the light is not there yet
            client.send(setExposure(i));
        }
        v1::ClientMessage ping;
        ping.mutable_ping();
        const uint64_t last = client.send(ping);
        // Errors come before it, as all answers do.
        const auto answer = client.expectErrorOr(v1::ServerMessage::kPong);
        ASSERT_TRUE(answer.has_pong()) << answer.error().message();
        EXPECT_EQ(answer.pong().ref_seq(), last);
    }
}

TEST(LongMessages, ViewerLeavesMeanwhile_ServerLives) {
    TestServer server({.sessions_max = 32}); // lost ones keep their places for a while
    for (int i = 0; i < 20; ++i) {
        WsClient client(server.port(), {.format = protocol::WireFormat::kText});
        client.join();
        client.send(placeLights(i));
        client.abort();
    }
    WsClient(server.port()).join();
}

TEST(Flood, EmptyFragmentsWithoutEnd_CloseWithPolicy) {
    TestServer server;
    Raw socket(server.port());
    std::string empty;
    for (size_t bytes = 0; bytes <= net::ReadBudget::kMostWithoutMessage; bytes += 6) {
        empty += Raw::frame(0x00, "");
    }
    socket.send(Raw::frame(0x01, "") + empty);
    EXPECT_EQ(socket.closeCode(), 1008);
}

TEST(Flood, ThousandsOfPings_AreToldAndTheViewerGoesOn) {
    TestServer server;
    Raw socket(server.port());
    const auto say = [&](v1::ClientMessage message, uint64_t seq) {
        message.set_seq(seq);
        socket.send(Raw::frame(Raw::kBinary, message.SerializeAsString()));
    };
    const auto hear = [&](v1::ServerMessage::BodyCase wanted) {
        v1::ServerMessage message;
        while (message.body_case() != wanted) {
            const auto frame = socket.read().value();
            if (frame.first == Raw::kBinary && frame.payload[1] == 2) { // no pong, no picture
                protocol::decodeServerMessage(protocol::bytesOf(frame.payload),
                                              protocol::WireFormat::kBinary, message)
                    .value();
            }
        }
        return message;
    };
    v1::ClientMessage hello;
    hello.mutable_hello()->set_protocol_major(protocol::kMajor);
    say(hello, 1);
    hear(v1::ServerMessage::kWelcome);
    std::string pings;
    for (double count = 0; count < 2 * net::ReadBudget::kMessages; ++count) {
        pings += Raw::frame(Raw::kPing, "");
    }
    socket.send(pings);
    EXPECT_EQ(hear(v1::ServerMessage::kError).error().code(), v1::ERROR_CODE_RATE_LIMIT);
    say(setExposure(3), 2);
    EXPECT_DOUBLE_EQ(hear(v1::ServerMessage::kState).state().state().exposure(), 3);
}

} // namespace
} // namespace froxel::test
