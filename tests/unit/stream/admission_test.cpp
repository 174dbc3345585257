#include "stream/admission.h"

#include <gmock/gmock.h>
#include <random>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class AdmissionTest : public testing::Test {
  protected:
    // Sessions 1 to n that all draw at this rate, at this cost, for some seconds.
    void draw(const std::vector<uint64_t>& sessions, double rate_hz, Seconds cost, double seconds) {
        const auto step = std::chrono::duration_cast<Clock::duration>(Seconds(1 / rate_hz));
        for (const TimePoint end =
                 now_ + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
             now_ < end; now_ += step) {
            for (const uint64_t session : sessions) {
                admission_.onFrame(session, cost, now_);
            }
        }
    }
    void add(const std::vector<uint64_t>& sessions, const session::Account& account = kHonest) {
        for (const uint64_t session : sessions) {
            admission_.add(session, account, now_);
        }
    }
    [[nodiscard]] bool admits(const session::Account& account = kHonest) const {
        return admission_.check(account, now_).has_value();
    }
    // Whose first picture costs so much.
    void newcomersCost(Seconds cost) { admission_.setMinRate(30, cost); }

    inline static const session::Account kHonest{"honest"};
    inline static const session::Account kOther{"other"};
    inline static const session::Account kHostile{"hostile"};

    TimePoint now_ = TimePoint() + 1h;
    Admission admission_{30};
};

TEST_F(AdmissionTest, NobodyThere_Admits) {
    EXPECT_TRUE(admits());
}

TEST_F(AdmissionTest, RoomForOneMoreAtTheFloor_Admits_UntilThereIsNone) {
    newcomersCost(5ms);
    // 5 ms a frame: six sessions at 30 frames a second take 0.9 of the device, seven 1.05.
    add({1, 2, 3, 4, 5});
    draw({1, 2, 3, 4, 5}, 40, 5ms, 5);
    EXPECT_TRUE(admits());
    add({6});
    draw({1, 2, 3, 4, 5, 6}, 33, 5ms, 5);
    const auto refused = admission_.check(kHonest, now_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message, HasSubstr("6 sessions may need 0.9 "));
    EXPECT_THAT(refused.error().message, HasSubstr("30 frames a second"));
    EXPECT_THAT(refused.error().message, HasSubstr("5 ms a frame"));
    EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
}

// Their rates say nothing about the floor then: all of the device's time is taken.
TEST_F(AdmissionTest, AlreadyBelowTheFloor_Refuses) {
    newcomersCost(50ms);
    add({1, 2});
    draw({1, 2}, 10, 50ms, 5);
    EXPECT_FALSE(admits());
}

// The surfaces of a view that rests are kept, which costs a third; it moves when its viewer does.
TEST_F(AdmissionTest, SessionsThatRest_CountAsIfTheyMoved) {
    newcomersCost(0.65ms);
    uint64_t let_in = 0;
    while (let_in < 80 && admits()) {
        add({++let_in});
        admission_.onFrame(let_in, 0.65ms, now_);
        for (int frame = 0; frame < 60; ++frame) {
            admission_.onFrame(let_in, 0.19ms, now_ += 16ms, true);
        }
    }
    EXPECT_NEAR(static_cast<double>(let_in), 51, 1) << "30 frames a second of 0.65 ms";
}

TEST_F(AdmissionTest, SessionWhoseOwnMovingViewIsKnown_CountsWithIt) {
    newcomersCost(10ms);
    add({1, 2, 3, 4, 5, 6, 7});
    draw({1, 2, 3, 4, 5, 6, 7}, 30, 2ms, 1);
    EXPECT_TRUE(admits()) << "0.06 each and one of 0.3";
    draw({1, 2, 3, 4, 5, 6, 7}, 30, 4ms, 1);
    EXPECT_FALSE(admits()) << "0.12 each";
}

TEST_F(AdmissionTest, ForgottenSessions_CountAsNothing) {
    newcomersCost(10ms);
    add({1, 2, 3});
    draw({1, 2, 3}, 30, 10ms, 5);
    now_ += 200s;
    EXPECT_FALSE(admits());
    now_ += 200s;
    EXPECT_TRUE(admits());
    draw({1, 2}, 30, 10ms, 5);
    EXPECT_TRUE(admits()) << "two at 0.3 each";
}

TEST_F(AdmissionTest, SessionThatDrawsSeldom_CountsAtTheFloor) {
    newcomersCost(20ms);
    add({1});
    draw({1}, 2, 20ms, 8);
    EXPECT_FALSE(admits()) << "0.6 each";
}

TEST_F(AdmissionTest, CrowdThatHasNotDrawnYet_CountsAtTheCostOfNewcomers) {
    newcomersCost(10ms);
    add({1});
    draw({1}, 30, 10ms, 5);
    EXPECT_TRUE(admits());
    add({2});
    EXPECT_TRUE(admits()) << "0.3 each";
    add({3});
    EXPECT_FALSE(admits());
    admission_.remove(3);
    EXPECT_TRUE(admits());
}

// As while the scene was loading: by the frame that was drawn for its cost.
TEST_F(AdmissionTest, CrowdBeforeTheFirstPicture_CountsAtTheCostOfNewcomers) {
    add({1, 2, 3, 4});
    EXPECT_TRUE(admits()) << "nothing is known";
    for (const uint64_t session : {1U, 2U, 3U, 4U}) {
        admission_.remove(session);
    }
    newcomersCost(10ms);
    EXPECT_TRUE(admits());
    add({1, 2});
    EXPECT_TRUE(admits()) << "0.3 each";
    add({3});
    const auto refused = admission_.check(kHonest, now_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("3 sessions may need 0.9 "));
}

TEST_F(AdmissionTest, SessionThatTakesNoFrames_CostsNothing_UntilItDoes) {
    newcomersCost(20ms);
    for (uint64_t paused = 1; paused <= 40; ++paused) {
        add({paused});
        admission_.setTakesFrames(paused, false, now_);
    }
    EXPECT_TRUE(admits());
    now_ += 1h;
    admission_.setTakesFrames(40, true, now_);
    EXPECT_FALSE(admits()) << "0.6 each";
}

TEST_F(AdmissionTest, SessionThatNeverDraws_IsExpectedToForAWhile) {
    newcomersCost(20ms);
    add({1});
    EXPECT_FALSE(admits()) << "0.6 each";
    now_ += 5min;
    EXPECT_TRUE(admits());
}

TEST_F(AdmissionTest, FrameThatCompiled_PricesNobody) {
    newcomersCost(2ms);
    add({1});
    draw({1}, 30, 2ms, 1);
    admission_.onFrame(1, 1s, now_);
    admission_.onFrame(1, 2ms, now_ += 1s);
    add({2, 3, 4});
    EXPECT_TRUE(admits());
    add({5, 6, 7});
    EXPECT_TRUE(admits());
}

TEST_F(AdmissionTest, CrowdWhereAllRest_CountsAtTheCostOfNewcomers) {
    newcomersCost(40ms);
    add({1});
    draw({1}, 30, 5ms, 5);
    now_ += 1h;
    EXPECT_TRUE(admits()) << "one always gets in";
    add({2});
    EXPECT_FALSE(admits()) << "1.2 each";
}

// Frames of 0.5 s, as many as the device draws: all of its time, and dear ones besides.
TEST_F(AdmissionTest, OneAccountFillsTheDevice_LeavesRoomForOthers) {
    newcomersCost(5ms);
    add({1}, kHostile);
    draw({1}, 2, 500ms, 8);
    EXPECT_FALSE(admits(kHostile));
    EXPECT_TRUE(admits(kHonest));
    add({2}, kHonest);
    draw({2}, 30, 5ms, 5);
    draw({1}, 2, 500ms, 1);
    EXPECT_TRUE(admits(kOther));
}

TEST_F(AdmissionTest, ManySessionsOfOneAccount_LeaveRoomForOthers) {
    newcomersCost(5ms);
    const std::vector<uint64_t> many{1, 2, 3, 4, 5, 6, 7, 8};
    add(many, kHostile);
    EXPECT_FALSE(admits(kHostile)) << "not drawn yet, 0.15 each";
    EXPECT_TRUE(admits(kHonest));
    draw(many, 10, 50ms, 5);
    EXPECT_FALSE(admits(kHostile));
    EXPECT_TRUE(admits(kHonest));
}

// Others count with their share at most, the newcomer's own account with all that it needs.
TEST_F(AdmissionTest, AccountBeyondItsShare_HasNoRoomForMoreOfItself) {
    newcomersCost(6ms);
    add({1}, kHonest);
    add({2}, kOther);
    for (int i = 0; i < 200; ++i, now_ += 25ms) {
        admission_.onFrame(1, 20ms, now_); // 0.6 of the device at the floor
        admission_.onFrame(2, 10ms, now_); // 0.3
    }
    EXPECT_FALSE(admits(kHonest));
    EXPECT_TRUE(admits(kOther)); // the first counts with half
    EXPECT_TRUE(admits(kHostile));
}

TEST_F(AdmissionTest, HonestAccountsFillTheDevice_OthersAreRefusedToo) {
    newcomersCost(5ms);
    std::vector<uint64_t> all;
    for (uint64_t session = 1; session <= 6; ++session) {
        EXPECT_TRUE(admits(kOther)) << session;
        EXPECT_LT(admission_.load(now_), 1) << session;
        all.push_back(session);
        add({session}, {std::to_string(session)});
        draw(all, 30, 5ms, 5);
    }
    EXPECT_FALSE(admits(kOther)) << "0.15 each";
    EXPECT_EQ(admission_.load(now_), 1);
}

TEST_F(AdmissionTest, CostOfNewcomersIsUnknown_IsNotHeldAgainstThem) {
    add({1}, kHostile);
    draw({1}, 2, 500ms, 8);
    EXPECT_TRUE(admits(kHonest));
}

TEST_F(AdmissionTest, SessionLeaves_MakesRoom) {
    newcomersCost(10ms);
    add({1, 2, 3});
    draw({1, 2, 3}, 30, 10ms, 5);
    EXPECT_FALSE(admits());
    admission_.remove(2);
    EXPECT_TRUE(admits());
}

TEST_F(AdmissionTest, FloorOfZero_AdmitsEveryone) {
    Admission off(0);
    off.add(1, kHostile, now_);
    for (int frame = 0; frame < 10; ++frame) {
        off.onFrame(1, 10s, now_ += 1s);
    }
    EXPECT_TRUE(off.check(kHonest, now_).has_value());
}

TEST_F(AdmissionTest, FramesOfUnknownSessions_AreIgnored) {
    admission_.onFrame(9, 1s, now_);
    EXPECT_TRUE(admits());
}

// Sessions of mixed costs that the scheduler would serve in turn: those who were let in all keep
// the floor, and one more than that would not have.
TEST_F(AdmissionTest, MixedCosts_FillTheDeviceAndNotMore) {
    std::mt19937 random(7);
    for (int run = 0; run < 20; ++run) {
        Admission admission;
        admission.setMinRate(30, Seconds(0.00225));
        TimePoint now = TimePoint() + 1h;
        std::vector<double> costs_s;
        while (costs_s.size() < 500 && admission.check(kHonest, now)) {
            costs_s.push_back(std::uniform_real_distribution<double>(0.0005, 0.004)(random));
            admission.add(costs_s.size(), kHonest, now);
            for (int frame = 0; frame < 150; ++frame) { // 5 s at 30 a second
                now += std::chrono::duration_cast<Clock::duration>(Seconds(1.0 / 30));
                for (size_t i = 0; i < costs_s.size(); ++i) {
                    admission.onFrame(i + 1, Seconds(costs_s[i]), now);
                }
            }
        }
        double busy = 0;
        for (const double cost_s : costs_s) {
            busy += cost_s * 30;
        }
        // The last one may have cost more than that by which it was judged.
        EXPECT_LE(busy, 1 + 0.004 * 30);
        EXPECT_GE(busy, 1 - 0.004 * 30);
    }
}

TEST_F(AdmissionTest, Load_IsOneWhereOneMoreIsTooMuchAndLessBefore) {
    newcomersCost(5ms);
    EXPECT_EQ(admission_.load(now_), 0);
    add({1, 2, 3, 4, 5});
    draw({1, 2, 3, 4, 5}, 40, 5ms, 5);
    EXPECT_TRUE(admits());
    EXPECT_NEAR(admission_.load(now_), 0.75 / 0.85, 0.01);
    add({6});
    draw({1, 2, 3, 4, 5, 6}, 33, 5ms, 5);
    EXPECT_FALSE(admits());
    EXPECT_EQ(admission_.load(now_), 1);
}

// It takes half of the device at the floor, and two would take more than all of it.
TEST_F(AdmissionTest, LoneSessionThatLeavesNoRoom_IsFullLoad) {
    newcomersCost(17ms);
    add({1});
    draw({1}, 30, 17ms, 5);
    EXPECT_FALSE(admits());
    EXPECT_EQ(admission_.load(now_), 1);
}

TEST_F(AdmissionTest, ForgottenSessions_AreNoLoad) {
    add({1});
    draw({1}, 30, 5ms, 5);
    now_ += std::chrono::duration_cast<Clock::duration>(Admission::kForgotten);
    EXPECT_EQ(admission_.load(now_), 0);
}
} // namespace
} // namespace froxel::stream
