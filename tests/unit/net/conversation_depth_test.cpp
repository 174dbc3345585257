// Depth with pictures, as one connection sees it.
#include "unit/net/conversation_fixture.h"

namespace froxel::net {
namespace {

v1::ClientMessage requestingDepth(bool wanted) {
    v1::ClientMessage message;
    message.mutable_request_depth()->set_wanted(wanted);
    return message;
}

constexpr DepthMeshSize kMesh(16, 16); // of the fixture's pictures

class DepthTest : public ConversationTest {
  protected:
    void frameWithDepth(uint64_t id, uint64_t number) {
        session::ReadyFrame ready;
        ready.record.depth_mesh = number;
        ready.depth = std::make_shared<const protocol::CodedDepthMesh>(protocol::encodeDepthMesh(
            std::vector<float>(kMesh.vertexCount(), static_cast<float>(number)), kMesh, 8));
        put(id, std::move(ready));
    }
    std::optional<v1::DepthMeshHeader> nextDepth() {
        const auto out = talk_.nextMessage(now_);
        v1::DepthMeshHeader header;
        if (!out || !protocol::decodeDepth(protocol::bytesOf(out->head), header)) {
            return {};
        }
        EXPECT_TRUE(protocol::decodeDepthMesh(*out->body, kMesh, header.bits()));
        return header;
    }
};

TEST_F(DepthTest, NotAskedFor_DoesNotCome) {
    join();
    frameWithDepth(1, 1);
    const v1::FrameHeader header = nextFrame();
    EXPECT_EQ(header.frame_id(), 1U);
    EXPECT_EQ(header.depth_mesh(), 0U);
    EXPECT_FALSE(header.has_picture_camera());
    EXPECT_FALSE(port_.session().states.back().sends_depth);
}

TEST_F(DepthTest, AskedFor_ComesBeforeItsPicture_AndOnceForAllThatHaveIt) {
    join();
    say(requestingDepth(true));
    EXPECT_TRUE(port_.session().states.back().sends_depth);
    frameWithDepth(1, 1);
    const auto depth = nextDepth();
    ASSERT_TRUE(depth);
    EXPECT_EQ(depth->number(), 1U);
    EXPECT_EQ(depth->columns(), 3U);
    EXPECT_EQ(depth->nearest_per_m(), 1);
    const v1::FrameHeader header = nextFrame();
    EXPECT_EQ(header.depth_mesh(), 1U);
    EXPECT_TRUE(header.has_picture_camera());
    EXPECT_EQ(metrics_->text().find("froxel_depth_bytes_total 0\n"), std::string::npos);
    ack(1);
    frameWithDepth(2, 1);
    EXPECT_EQ(nextFrame().frame_id(), 2U);
    ack(2);
    frameWithDepth(3, 2); // replaced before it is sent, and its depth with it
    frameWithDepth(4, 3);
    EXPECT_EQ(nextDepth().value().number(), 3U);
    EXPECT_EQ(nextFrame().frame_id(), 4U);
    ack(4);
    say(requestingDepth(false));
    EXPECT_FALSE(port_.session().states.back().sends_depth);
    frameWithDepth(5, 4);
    EXPECT_EQ(nextFrame().depth_mesh(), 0U);
}

TEST_F(DepthTest, Request_HasAPictureDrawn) {
    join();
    const uint64_t version = port_.session().states.back().version;
    say(requestingDepth(true));
    EXPECT_GT(port_.session().states.back().version, version);
}

TEST_F(DepthTest, RequestedAgainAndAgain_IsRefused) {
    join();
    for (int i = 0; i < Conversation::kDepthRequestsAtOnce; ++i) {
        say(requestingDepth(i % 2 == 0));
    }
    drainAnswers();
    say(requestingDepth(true));
    EXPECT_EQ(nextAnswer().value().error().message(), "more than 5 requests for depth a second");
}

TEST_F(DepthTest, ServerThatSendsNone_SaysSo) {
    ServiceStatus status;
    status.serving = Serving{.context = std::make_shared<const session::SessionContext>(),
                             .port = &port_,
                             .offers_depth = false};
    talk_.onService(status, now_);
    hello();
    EXPECT_FALSE(nextAnswer().value().welcome().offers_depth());
    drainAnswers();
    say(requestingDepth(false));
    EXPECT_FALSE(nextAnswer());
    say(requestingDepth(true));
    const v1::Error error = nextAnswer().value().error();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_UNSUPPORTED);
    EXPECT_EQ(error.field(), "wanted");
    EXPECT_EQ(error.message(), "this server sends you no depth");
    EXPECT_FALSE(port_.session().states.back().sends_depth);
}

} // namespace
} // namespace froxel::net
