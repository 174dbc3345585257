#include "net/outbox.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

session::ReadyFrame frame(uint64_t id) {
    session::ReadyFrame ready;
    ready.record.frame_id = id;
    return ready;
}

TEST(Outbox, Next_Empty_IsNothing) {
    EXPECT_EQ(Outbox().next(true), Outbox::Next::kNothing);
}

TEST(Outbox, PutFrame_OneWaits_IsReplacedAndCounted) {
    Outbox outbox;
    outbox.putFrame(frame(1));
    outbox.putFrame(frame(2));
    outbox.putFrame(frame(3));
    EXPECT_EQ(outbox.takeFrame().record.frame_id, 3U);
    EXPECT_EQ(outbox.droppedCount(), 2U);
    EXPECT_FALSE(outbox.hasFrame());
}

TEST(Outbox, Next_FrameNotAllowed_StaysInItsSlot) {
    Outbox outbox;
    outbox.putFrame(frame(1));
    EXPECT_EQ(outbox.next(false), Outbox::Next::kNothing);
    EXPECT_EQ(outbox.next(true), Outbox::Next::kFrame);
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
    outbox.putFrame(frame(1));
    outbox.putState();
    ASSERT_TRUE(outbox.putAnswer({"answer", nullptr, {}}));
    EXPECT_EQ(outbox.next(true), Outbox::Next::kAnswer);
}

TEST(Outbox, Next_StatesAndFramesKeepComing_TakeTurns) {
    Outbox outbox;
    outbox.putState();
    outbox.putFrame(frame(1));
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(outbox.next(true), Outbox::Next::kState);
        outbox.takeState();
        outbox.putState();
        ASSERT_EQ(outbox.next(true), Outbox::Next::kFrame);
        EXPECT_EQ(outbox.takeFrame().record.frame_id, 1U);
        outbox.putFrame(frame(1));
    }
}

TEST(Outbox, KeepAnswersOnly_Closing_LeavesNothingElse) {
    Outbox outbox;
    outbox.putState();
    outbox.putFrame(frame(1));
    ASSERT_TRUE(outbox.putAnswer({"last words", nullptr, {}}));
    outbox.keepAnswersOnly();
    EXPECT_EQ(outbox.takeAnswer().head, "last words");
    EXPECT_EQ(outbox.next(true), Outbox::Next::kNothing);
}

} // namespace
} // namespace froxel::net
