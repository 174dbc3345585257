#include "net/outbox.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::net {
namespace {

session::ReadyFrame frame(uint64_t id) {
    session::ReadyFrame ready;
    ready.record.frame_id = id;
    return ready;
}

session::ReadyFrame video(uint64_t id, bool key = false) {
    session::ReadyFrame ready = frame(id);
    ready.record.delivered.encoding.codec = settings::Codec::kVp9;
    ready.record.key = key;
    return ready;
}

std::vector<uint64_t> takeAll(Outbox& outbox) {
    std::vector<uint64_t> ids;
    while (outbox.hasFrame()) {
        ids.push_back(outbox.takeFrame().record.frame_id);
    }
    return ids;
}

TEST(Outbox, Next_Empty_IsNothing) {
    EXPECT_EQ(Outbox().next({}), Outbox::Next::kNothing);
}

TEST(Outbox, PutFrame_OneWaits_IsReplacedAndCounted) {
    Outbox outbox;
    (void)outbox.putFrame(frame(1));
    (void)outbox.putFrame(frame(2));
    (void)outbox.putFrame(frame(3));
    EXPECT_EQ(outbox.takeFrame().record.frame_id, 3U);
    EXPECT_EQ(outbox.droppedCount(), 2U);
    EXPECT_FALSE(outbox.hasFrame());
}

TEST(Outbox, Next_FrameNotAllowed_StaysInItsSlot) {
    Outbox outbox;
    (void)outbox.putFrame(frame(1));
    EXPECT_EQ(outbox.next({.frame = false}), Outbox::Next::kNothing);
    EXPECT_EQ(outbox.next({}), Outbox::Next::kFrame);
}

TEST(Outbox, PutAnswer_QueueFull_IsRefused) {
    Outbox outbox;
    for (size_t i = 0; i < Outbox::kMaxAnswers; ++i) {
        ASSERT_TRUE(outbox.putAnswer({std::to_string(i), nullptr, {}}));
    }
    EXPECT_FALSE(outbox.putAnswer({"one more", nullptr, {}}));
    EXPECT_EQ(outbox.takeAnswer().head, "0");
}

TEST(Outbox, Next_AnswerWaits_ComesFirst) {
    Outbox outbox;
    (void)outbox.putFrame(frame(1));
    outbox.putState();
    ASSERT_TRUE(outbox.putAnswer({"answer", nullptr, {}}));
    EXPECT_EQ(outbox.next({}), Outbox::Next::kAnswer);
}

TEST(Outbox, Next_StateNotAllowed_LeavesTheWayToFrames) {
    Outbox outbox;
    outbox.putState();
    (void)outbox.putFrame(frame(1));
    EXPECT_EQ(outbox.next({}), Outbox::Next::kState);
    EXPECT_EQ(outbox.next({.state = false}), Outbox::Next::kFrame);
    EXPECT_EQ(outbox.next({.state = false, .frame = false}), Outbox::Next::kNothing);
    EXPECT_TRUE(outbox.hasState());
    outbox.takeState();
    EXPECT_FALSE(outbox.hasState());
    EXPECT_EQ(outbox.next({}), Outbox::Next::kFrame);
}

TEST(Outbox, KeepAnswersOnly_Closing_LeavesNothingElse) {
    Outbox outbox;
    outbox.putState();
    (void)outbox.putFrame(frame(1));
    ASSERT_TRUE(outbox.putAnswer({"last words", nullptr, {}}));
    outbox.keepAnswersOnly();
    EXPECT_EQ(outbox.takeAnswer().head, "last words");
    EXPECT_EQ(outbox.next({}), Outbox::Next::kNothing);
}

TEST(Outbox, Video_WaitsInItsOrder) {
    Outbox outbox;
    EXPECT_EQ(outbox.putFrame(video(1, true)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(video(2)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(video(3)), Outbox::Put::kKept);
    EXPECT_EQ(takeAll(outbox), (std::vector<uint64_t>{1, 2, 3}));
    EXPECT_EQ(outbox.droppedCount(), 0U);
    EXPECT_EQ(outbox.putFrame(video(4)), Outbox::Put::kKept);
}

TEST(Outbox, Video_KeyFrame_ReplacesWhatWaits) {
    Outbox outbox;
    (void)outbox.putFrame(video(1, true));
    (void)outbox.putFrame(video(2));
    EXPECT_EQ(outbox.putFrame(video(3, true)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(video(4)), Outbox::Put::kKept);
    EXPECT_EQ(takeAll(outbox), (std::vector<uint64_t>{3, 4}));
    EXPECT_EQ(outbox.droppedCount(), 2U);
}

TEST(Outbox, Video_BeforeAnyKeyFrame_IsLost) {
    Outbox outbox;
    EXPECT_EQ(outbox.putFrame(video(1)), Outbox::Put::kLost);
    EXPECT_FALSE(outbox.hasFrame());
    EXPECT_EQ(outbox.putFrame(video(2, true)), Outbox::Put::kKept);
}

TEST(Outbox, Video_QueueFull_IsLostUpToTheNextKeyFrame) {
    Outbox outbox;
    (void)outbox.putFrame(video(1, true));
    for (uint64_t id = 2; id <= Outbox::kMaxFrames; ++id) {
        ASSERT_EQ(outbox.putFrame(video(id)), Outbox::Put::kKept);
    }
    EXPECT_EQ(outbox.putFrame(video(50)), Outbox::Put::kLost);
    EXPECT_FALSE(outbox.hasFrame()) << "late, and a key frame is to come";
    EXPECT_EQ(outbox.putFrame(video(51)), Outbox::Put::kLost) << "refers to the lost one";
    EXPECT_EQ(outbox.putFrame(video(52, true)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(video(53)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.droppedCount(), Outbox::kMaxFrames + 2);
}

// As of a room's viewer whose link takes fewer frames than the others'.
TEST(Outbox, Video_WaitsTooLong_IsDroppedUpToTheNextKeyFrame) {
    Outbox outbox;
    const auto at = [](session::ReadyFrame ready, Seconds time) {
        ready.ready_at = TimePoint() + std::chrono::duration_cast<Clock::duration>(time);
        return ready;
    };
    EXPECT_EQ(outbox.putFrame(at(video(1, true), Seconds(1))), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(at(video(2), Seconds(1) + Outbox::kMaxWait)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(at(video(3), Seconds(1.1) + Outbox::kMaxWait)), Outbox::Put::kLost);
    EXPECT_FALSE(outbox.hasFrame());
    EXPECT_EQ(outbox.droppedCount(), 3U);
}

TEST(Outbox, InterruptVideo_LeavesImagesAndWaitsForAKeyFrame) {
    Outbox outbox;
    EXPECT_FALSE(outbox.interruptVideo()) << "there is none";
    (void)outbox.putFrame(frame(1));
    EXPECT_FALSE(outbox.interruptVideo());
    EXPECT_EQ(takeAll(outbox), (std::vector<uint64_t>{1}));
    (void)outbox.putFrame(video(2, true));
    EXPECT_TRUE(outbox.interruptVideo());
    EXPECT_FALSE(outbox.hasFrame());
    EXPECT_EQ(outbox.putFrame(video(3)), Outbox::Put::kLost);
    EXPECT_EQ(outbox.putFrame(video(4, true)), Outbox::Put::kKept);
}

TEST(Outbox, Video_AfterAJpeg_GoesOnOnlyWhereNoFrameWasReplaced) {
    Outbox outbox;
    (void)outbox.putFrame(video(1, true));
    (void)takeAll(outbox);
    (void)outbox.putFrame(frame(2));
    EXPECT_EQ(outbox.putFrame(video(3)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(frame(4)), Outbox::Put::kKept); // replaces 3
    EXPECT_EQ(outbox.putFrame(video(5)), Outbox::Put::kLost);
    EXPECT_EQ(takeAll(outbox), (std::vector<uint64_t>{4}));
}

} // namespace
} // namespace froxel::net
