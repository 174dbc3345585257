// A conversation without a socket: what a client says to it, and what it would write.
#pragma once

#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "net/conversation.h"
#include "support/fake_port.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace froxel::net {

using namespace std::chrono_literals;
using protocol::WireFormat;
using test::FakePort;

class ConversationTest : public testing::Test {
  protected:
    void serve() {
        ServiceStatus status;
        status.serving = Serving{std::make_shared<const session::SessionContext>(), &port_};
        talk_.onService(status, now_);
    }
    uint64_t say(v1::ClientMessage message) {
        message.set_seq(++seq_);
        talk_.onMessage(protocol::bytesOf(message.SerializeAsString()), WireFormat::kBinary, now_);
        return seq_;
    }
    void hello(bool with_video = false) {
        v1::ClientMessage message;
        message.mutable_hello()->set_protocol_major(protocol::kMajor);
        if (with_video) {
            message.mutable_hello()->add_codecs(v1::CODEC_VP9);
            message.mutable_hello()->add_codecs(static_cast<v1::Codec>(99)); // a newer client's
        }
        say(message);
    }
    void join() {
        serve();
        hello();
        drainAnswers();
    }
    void joinWithVideo() {
        serve();
        hello(true);
        setCodec(v1::CODEC_VP9);
        drainAnswers();
    }
    uint64_t setExposure(double exposure) {
        v1::ClientMessage message;
        message.mutable_set_exposure()->set_exposure(exposure);
        return say(message);
    }
    uint64_t setCodec(v1::Codec codec) {
        v1::ClientMessage message;
        message.mutable_set_encoding()->set_codec(codec);
        return say(message);
    }
    uint64_t ack(uint64_t frame_id) {
        v1::ClientMessage message;
        message.mutable_ack()->set_frame_id(frame_id);
        return say(message);
    }
    void video(uint64_t id, bool key) {
        session::ReadyFrame ready;
        ready.record.delivered.encoding.codec = settings::Codec::kVp9;
        ready.record.key = key;
        put(id, std::move(ready));
    }
    void frame(uint64_t id, std::shared_ptr<const FrameDetails> details = nullptr) {
        session::ReadyFrame ready;
        ready.record.stats.details = std::move(details);
        put(id, std::move(ready));
    }
    void put(uint64_t id, session::ReadyFrame ready) {
        ready.record.frame_id = id;
        ready.record.width_px = 16;
        ready.record.height_px = 16;
        ready.bytes = std::make_shared<const std::vector<std::byte>>(10);
        ready.ready_at = now_;
        port_.sink()->deliver(std::move(ready));
    }
    std::optional<v1::ServerMessage> nextAnswer() {
        auto out = talk_.nextMessage(now_);
        if (!out) {
            return {};
        }
        if (out->unmade) {
            out->make();
        }
        v1::ServerMessage message;
        protocol::decodeServerMessage(protocol::bytesOf(out->head), out->format, message).value();
        return message;
    }
    v1::FrameHeader nextFrame() {
        const auto out = talk_.nextMessage(now_).value();
        v1::FrameHeader header;
        EXPECT_TRUE(header.ParseFromString(out.head.substr(protocol::kPrefixBytes)));
        return header;
    }
    void drainAnswers() {
        while (talk_.nextMessage(now_)) {
        }
    }

    FakePort port_;
    TimePoint now_ = TimePoint() + 1h;
    std::shared_ptr<Metrics> metrics_ = std::make_shared<Metrics>();
    // What the session tells goes straight to the conversation.
    struct Viewer final : SessionViewer {
        void tell(Notice notice) override { talk->onNotice(std::move(notice)); }
        Conversation* talk = nullptr;
    };
    std::shared_ptr<Viewer> viewer_ = std::make_shared<Viewer>();
    std::shared_ptr<Lobby> lobby_ = std::make_shared<Lobby>(LobbyRules{.resume_grace = 10s});
    Conversation talk_{viewer_, lobby_, metrics_, Caller{{"192.0.2.7"}, false, {}}};
    uint64_t seq_ = 0;

    ConversationTest() { viewer_->talk = &talk_; }
};

} // namespace froxel::net
