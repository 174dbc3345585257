// Video in a session of several viewers.
#include "net/lobby.h"
#include "support/fake_port.h"
#include "support/settings.h"

#include <gtest/gtest.h>

#include <chrono>

namespace froxel::net {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint kNow = TimePoint() + 1h;
constexpr auto kVp9 = static_cast<size_t>(settings::Codec::kVp9);

class VideoSessionTest : public testing::Test {
  protected:
    struct Viewer final : SessionViewer {
        void tell(Notice notice) override {
            if (const auto* frame = std::get_if<session::ReadyFrame>(&notice)) {
                frames.push_back(frame->record.frame_id);
            }
            state_news += std::holds_alternative<StateNews>(notice) ? 1U : 0U;
        }
        std::vector<uint64_t> frames;
        uint32_t state_news = 0;
    };
    Seat enter(const std::shared_ptr<Viewer>& viewer, bool decodes_video) {
        session::Hello hello;
        hello.room = "hall";
        hello.codecs.set(kVp9, decodes_video);
        return lobby_.enter(serving_, hello, {}, viewer, kNow).value();
    }
    static bool setCodec(const Seat& seat, settings::Codec codec) {
        const auto set = test::settings({{"codec", test::chosen(codec)}});
        return seat.session->apply(seat.place, {{1, 0}, set}, kNow).has_value();
    }
    void deliver(uint64_t id, bool key) {
        session::ReadyFrame frame;
        frame.record.frame_id = id;
        frame.record.delivered.encoding.codec = settings::Codec::kVp9;
        frame.record.key = key;
        port_.sink()->deliver(std::move(frame));
    }
    const session::SessionState& state() { return port_.session().states.back(); }

    test::FakePort port_;
    Serving serving_{std::make_shared<const session::SessionContext>(), &port_};
    Lobby lobby_{LobbyRules{.resume_grace = 10s}};
    std::shared_ptr<Viewer> first_ = std::make_shared<Viewer>();
    std::shared_ptr<Viewer> second_ = std::make_shared<Viewer>();
};

TEST_F(VideoSessionTest, Codec_OnlyWhileAllViewersDecodeIt) {
    const Seat first = enter(first_, true);
    EXPECT_TRUE(setCodec(first, settings::Codec::kVp9));
    const uint32_t news = first_->state_news;
    const Seat second = enter(second_, false);
    EXPECT_EQ(state().encoding.codec, settings::Codec::kJpeg);
    EXPECT_GT(first_->state_news, news);
    EXPECT_FALSE(setCodec(first, settings::Codec::kVp9));
    lobby_.depart(second, Departure::kLost, kNow);
    EXPECT_TRUE(setCodec(first, settings::Codec::kVp9)) << "it may never come back";
    EXPECT_EQ(state().encoding.codec, settings::Codec::kVp9);
}

TEST_F(VideoSessionTest, LateViewer_BeginsWithAKeyFrame) {
    const Seat first = enter(first_, true);
    EXPECT_TRUE(setCodec(first, settings::Codec::kVp9));
    deliver(1, true);
    const uint64_t before = state().key_requests;
    EXPECT_EQ(enter(second_, true).picture->record.frame_id, 1U) << "decodes by itself";
    deliver(2, false);
    const auto third = std::make_shared<Viewer>();
    EXPECT_FALSE(enter(third, true).picture) << "its conversation asks for one";
    EXPECT_EQ(state().key_requests, before);
}

TEST_F(VideoSessionTest, KeyFrames_AreSharedByThoseWhoAskMeanwhile) {
    const Seat first = enter(first_, true);
    const Seat second = enter(second_, true);
    EXPECT_TRUE(setCodec(first, settings::Codec::kVp9));
    deliver(1, true);
    const session::SessionState before = state();
    EXPECT_FALSE(first.session->requestKeyFrame(second.place, kNow)); // watches, and may
    EXPECT_FALSE(first.session->requestKeyFrame(first.place, kNow));
    EXPECT_EQ(state().key_requests, before.key_requests + 1);
    EXPECT_GT(state().version, before.version);
    deliver(2, false); // was under way
    EXPECT_FALSE(first.session->requestKeyFrame(second.place, kNow));
    EXPECT_EQ(state().key_requests, before.key_requests + 1);
    deliver(3, true);
    EXPECT_FALSE(first.session->requestKeyFrame(second.place, kNow));
    EXPECT_EQ(state().key_requests, before.key_requests + 2);
}

TEST_F(VideoSessionTest, KeyFrames_AskedForAgainAndAgain_AreLeftOutAndToldWhen) {
    const Seat first = enter(first_, true);
    EXPECT_TRUE(setCodec(first, settings::Codec::kVp9));
    deliver(1, true);
    const uint64_t before = state().key_requests;
    for (uint64_t id = 2; id < 12; ++id) {
        const auto later = first.session->requestKeyFrame(first.place, kNow);
        EXPECT_EQ(later.has_value(), id >= 5) << id;
        deliver(id, true);
    }
    EXPECT_EQ(state().key_requests, before + 3);
    const auto later = first.session->requestKeyFrame(first.place, kNow);
    ASSERT_TRUE(later);
    EXPECT_EQ(*later, kNow + 1s);
    EXPECT_FALSE(first.session->requestKeyFrame(first.place, *later));
    EXPECT_EQ(state().key_requests, before + 4);
}

} // namespace
} // namespace froxel::net
