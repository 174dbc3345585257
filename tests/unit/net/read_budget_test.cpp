#include "net/paced_reads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace froxel::net {
namespace {

using namespace std::chrono_literals;
using Standing = ReadBudget::Standing;

constexpr size_t kAll = static_cast<size_t>(ReadBudget::kBytesAtOnce);

class ReadBudgetTest : public testing::Test {
  protected:
    // Messages of up to 64 KiB, as many as may be read within so many seconds.
    void read(int seconds) {
        for (int i = 0; i < 100 * seconds && budget_.standing() != Standing::kSpent; ++i) {
            now_ += 10ms;
            budget_.onBytes(std::min(budget_.readable(now_), protocol::kMaxMessageBytes), now_);
            budget_.onMessage(now_);
        }
    }

    TimePoint now_ = TimePoint() + 1h;
    ReadBudget budget_;
};

TEST_F(ReadBudgetTest, Readable_Fresh_IsAllAtOnce) {
    EXPECT_EQ(budget_.readable(now_), kAll);
    EXPECT_EQ(budget_.standing(), Standing::kWithin);
}

TEST_F(ReadBudgetTest, Readable_AllWasRead_ComesBackByTheSecond) {
    budget_.onBytes(kAll / 2, now_);
    budget_.onMessage(now_);
    budget_.onBytes(budget_.readable(now_), now_);
    EXPECT_EQ(budget_.readable(now_), 0U);
    EXPECT_EQ(budget_.standing(), Standing::kThrottled);
    EXPECT_NEAR(static_cast<double>(budget_.readable(now_ + 2s)), 2 * ReadBudget::kBytesPerSecond,
                1);
}

TEST_F(ReadBudgetTest, Standing_NeverMoreThanIsReadASecond_StaysWithin) {
    for (int i = 0; i < 6000; ++i) { // ten minutes
        now_ += 100ms;
        budget_.onBytes(static_cast<size_t>(ReadBudget::kBytesPerSecond * 0.07), now_);
        budget_.onMessage(now_);
    }
    EXPECT_EQ(budget_.standing(), Standing::kWithin);
}

TEST_F(ReadBudgetTest, Standing_AllThatIsReadable_IsThrottledAtOnceAndSpentInTheEnd) {
    read(1);
    EXPECT_EQ(budget_.standing(), Standing::kThrottled);
    read(60);
    EXPECT_EQ(budget_.standing(), Standing::kSpent);
}

TEST_F(ReadBudgetTest, OnWork_ASecond_CostsTwelveSecondsOfReading) {
    budget_.onWork(50ms, now_);
    EXPECT_NEAR(static_cast<double>(budget_.readable(now_)),
                ReadBudget::kBytesAtOnce - 0.6 * ReadBudget::kBytesPerSecond, 1);
}

TEST_F(ReadBudgetTest, OnControlFrame_MoreThanAtOnce_IsThrottled) {
    for (double i = 0; i < ReadBudget::kMessages; ++i) {
        EXPECT_EQ(budget_.standing(), Standing::kWithin);
        budget_.onControlFrame(now_);
    }
    EXPECT_EQ(budget_.standing(), Standing::kThrottled);
}

TEST_F(ReadBudgetTest, Readable_ShortMessagesWithoutEnd_AreAsManyAsASecondTakes) {
    double messages = 0;
    for (int i = 0; i < 10'000; ++i) { // ten seconds
        now_ += 1ms;
        for (int at_once = 0; at_once < 10 && budget_.readable(now_) > 0; ++at_once) {
            budget_.onBytes(10, now_);
            budget_.onMessage(now_);
            ++messages;
        }
    }
    EXPECT_NEAR(messages, 11 * ReadBudget::kMessages, 1);
    EXPECT_EQ(budget_.standing(), Standing::kThrottled);
}

TEST_F(ReadBudgetTest, Standing_AckAndCameraOf240PicturesASecond_StaysWithin) {
    for (int i = 0; i < 480 * 60; ++i) {
        now_ += 2083us;
        budget_.onBytes(60, now_);
        budget_.onMessage(now_);
    }
    EXPECT_EQ(budget_.standing(), Standing::kWithin);
}

TEST_F(ReadBudgetTest, Standing_BytesWithoutEndOfAMessage_IsSpent) {
    budget_.onBytes(ReadBudget::kMostWithoutMessage, now_);
    EXPECT_EQ(budget_.standing(), Standing::kWithin);
    budget_.onBytes(1, now_);
    EXPECT_EQ(budget_.standing(), Standing::kSpent);
}

TEST_F(ReadBudgetTest, Standing_ControlFramesBetweenFragments_EndNoMessage) {
    budget_.onBytes(ReadBudget::kMostWithoutMessage, now_);
    budget_.onControlFrame(now_);
    budget_.onBytes(1, now_);
    EXPECT_EQ(budget_.standing(), Standing::kSpent);
}

TEST_F(ReadBudgetTest, Standing_LongMessageInFragmentsOfAByte_StaysWithin) {
    for (int i = 0; i < 2; ++i) {
        budget_.onBytes(7 * protocol::kMaxMessageBytes, now_);
        budget_.onMessage(now_);
    }
    EXPECT_EQ(budget_.standing(), Standing::kWithin);
}

TEST(PacedReads, Begin_AfterRequestsThatSpentItAll_TellsOfTheNextFloodAnew) {
    const TimePoint now = TimePoint() + 1h;
    PacedReads reads; // of a connection that asked for many pages
    reads.count(&ReadBudget::onBytes, ReadBudget::kMostWithoutMessage + 1, now);
    ASSERT_EQ(reads.standing(), Standing::kSpent);
    std::vector<Standing> told;
    reads.begin([&told](Standing standing) { told.push_back(standing); });
    EXPECT_EQ(reads.standing(), Standing::kWithin);
    for (size_t read = 0; read < 2 * kAll; read += protocol::kMaxMessageBytes) {
        reads.count(&ReadBudget::onBytes, protocol::kMaxMessageBytes, now);
        reads.count(&ReadBudget::onMessage, now);
    }
    EXPECT_EQ(told, (std::vector{Standing::kThrottled, Standing::kSpent}));
}

} // namespace
} // namespace froxel::net
