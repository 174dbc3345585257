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
    ready.record.delivered.encoding.codec = view::Codec::kVp9;
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
    EXPECT_EQ(Outbox().next(true), Outbox::Next::kNothing);
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
    (void)outbox.putFrame(frame(1));
    outbox.putState();
    ASSERT_TRUE(outbox.putAnswer({"answer", nullptr, {}}));
    EXPECT_EQ(outbox.next(true), Outbox::Next::kAnswer);
}

TEST(Outbox, Next_StatesAndFramesKeepComing_TakeTurns) {
    Outbox outbox;
    outbox.putState();
    (void)outbox.putFrame(frame(1));
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(outbox.next(true), Outbox::Next::kState);
        outbox.takeState();
        outbox.putState();
        ASSERT_EQ(outbox.next(true), Outbox::Next::kFrame);
        EXPECT_EQ(outbox.takeFrame().record.frame_id, 1U);
        (void)outbox.putFrame(frame(1));
    }
}

TEST(Outbox, KeepAnswersOnly_Closing_LeavesNothingElse) {
    Outbox outbox;
    outbox.putState();
    (void)outbox.putFrame(frame(1));
    ASSERT_TRUE(outbox.putAnswer({"last words", nullptr, {}}));
    outbox.keepAnswersOnly();
    EXPECT_EQ(outbox.takeAnswer().head, "last words");
    EXPECT_EQ(outbox.next(true), Outbox::Next::kNothing);
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
    EXPECT_EQ(takeAll(outbox).size(), Outbox::kMaxFrames) << "those before it are good";
    EXPECT_EQ(outbox.putFrame(video(51)), Outbox::Put::kLost) << "refers to the lost one";
    EXPECT_EQ(outbox.putFrame(video(52, true)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.putFrame(video(53)), Outbox::Put::kKept);
    EXPECT_EQ(outbox.droppedCount(), 2U);
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
