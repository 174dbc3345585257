// Video: its codec is agreed on, its frames go out in order, and what is lost is mended.
#include "unit/net/conversation_fixture.h"

namespace froxel::net {
namespace {

TEST_F(ConversationTest, Codec_NotInHello_IsRefusedAndNamed) {
    join();
    const uint64_t seq = setCodec(v1::CODEC_VP9);
    const auto answer = nextAnswer().value();
    EXPECT_EQ(answer.error().code(), v1::ERROR_CODE_UNSUPPORTED);
    EXPECT_EQ(answer.error().ref_seq(), seq);
    EXPECT_EQ(answer.error().field(), "codec");
    EXPECT_EQ(answer.error().message(), "codec is vp9; not every viewer's Hello.codecs lists it");
}

TEST_F(ConversationTest, Codec_InHello_IsTaken) {
    serve();
    hello(true);
    drainAnswers();
    setCodec(v1::CODEC_VP9);
    EXPECT_EQ(port_.session().states.back().encoding.codec, settings::Codec::kVp9);
    EXPECT_EQ(nextAnswer()->state().state().codec(), v1::CODEC_VP9);
}

TEST_F(ConversationTest, Video_IsSentInOrderAndSaysWhichIsAKeyFrame) {
    join();
    video(1, true);
    video(2, false);
    const auto first = nextFrame();
    EXPECT_EQ(first.frame_id(), 1U);
    EXPECT_EQ(first.parts(0).codec(), v1::CODEC_VP9);
    EXPECT_TRUE(first.parts(0).key_frame());
    const auto second = nextFrame();
    EXPECT_EQ(second.frame_id(), 2U);
    EXPECT_FALSE(second.parts(0).key_frame());
    EXPECT_EQ(second.dropped_frames(), 0U);
}

TEST_F(ConversationTest, Video_AFrameIsLost_OneKeyFrameIsDemandedAndNoneSentBeforeIt) {
    joinWithVideo();
    const session::SessionState before = port_.session().states.back();
    video(1, false);
    video(2, false);
    EXPECT_FALSE(talk_.nextMessage(now_));
    EXPECT_EQ(port_.session().states.back().key_requests, before.key_requests + 1);
    EXPECT_EQ(port_.session().states.back().version, before.version + 1) << "so that one is drawn";
    video(3, true);
    EXPECT_EQ(nextFrame().frame_id(), 3U);
    EXPECT_EQ(port_.session().states.back().key_requests, before.key_requests + 1);
}

TEST_F(ConversationTest, Video_LostWhileThereIsNoRoom_KeyFrameIsDemandedWhenThereIs) {
    joinWithVideo();
    const uint64_t before = port_.session().states.back().key_requests;
    video(1, true);
    video(2, false);
    (void)nextFrame();
    (void)nextFrame(); // the window is full
    const uint64_t last = 3 + Outbox::kMaxFrames;
    for (uint64_t id = 3; id <= last; ++id) {
        video(id, false);
    }
    EXPECT_EQ(port_.session().states.back().key_requests, before);
    for (uint64_t id = 1; id < last; ++id) {
        ack(id);
        drainAnswers(); // what waits follows in its order
    }
    EXPECT_EQ(port_.session().states.back().key_requests, before + 1);
}

// A picture that waits shows the viewer what there is: a key frame is for after it.
TEST_F(ConversationTest, Video_BegunAgainWhileAPictureWaits_DemandsNoKeyFrameYet) {
    joinWithVideo();
    const uint64_t before = port_.session().states.back().key_requests;
    video(1, true);
    (void)nextFrame();
    frame(2);
    for (const bool paused : {true, false}) {
        v1::ClientMessage message;
        message.mutable_pause()->set_paused(paused);
        say(message);
    }
    EXPECT_EQ(port_.session().states.back().key_requests, before);
    drainAnswers();
    ack(2);
    EXPECT_EQ(port_.session().states.back().key_requests, before + 1);
}

TEST_F(ConversationTest, RequestKeyFrame_OnlyOfVideo_IsPassedOn) {
    v1::ClientMessage message;
    message.mutable_request_key_frame();
    serve();
    hello(true);
    drainAnswers();
    const uint64_t before = port_.session().states.back().key_requests;
    say(message);
    EXPECT_EQ(port_.session().states.back().key_requests, before) << "JPEG";
    setCodec(v1::CODEC_VP9);
    say(message);
    say(message); // the first is not answered yet
    EXPECT_EQ(port_.session().states.back().key_requests, before + 1);
    video(1, true);
    say(message);
    EXPECT_EQ(port_.session().states.back().key_requests, before + 2);
}

} // namespace
} // namespace froxel::net
