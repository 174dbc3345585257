#include "session/pacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

TEST(CreditWindow, Fresh_LetsTwoFramesOut) {
    CreditWindow window;
    const TimePoint now{1s};
    EXPECT_TRUE(window.open());
    window.onSent(1, now);
    EXPECT_TRUE(window.open());
    window.onSent(2, now);
    EXPECT_FALSE(window.open());
    EXPECT_EQ(window.onAck(1, now + 5ms), AckOutcome::kFresh);
    EXPECT_TRUE(window.open());
    EXPECT_EQ(window.inFlight(), 1U);
}

TEST(CreditWindow, Ack_CoversAllBeforeIt) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(4, now);
    window.onSent(9, now);
    EXPECT_EQ(window.onAck(9, now + 1ms), AckOutcome::kFresh);
    EXPECT_EQ(window.inFlight(), 0U);
    EXPECT_EQ(window.onAck(4, now + 2ms), AckOutcome::kStale);
    EXPECT_EQ(window.onAck(9, now + 2ms), AckOutcome::kStale);
    EXPECT_EQ(window.onAck(10, now + 2ms), AckOutcome::kUnknown);
    EXPECT_EQ(window.onAck(0, now + 2ms), AckOutcome::kUnknown);
}

TEST(CreditWindow, NoAck_StaysShut) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(1, now);
    EXPECT_TRUE(window.open());
    window.onSent(2, now + 1s);
    EXPECT_FALSE(window.open());
    window.onAck(1, now + 5s);
    EXPECT_TRUE(window.open());
}

// Frames that a client decodes are on their way too.
TEST(CreditWindow, SlowDecoder_GetsAsManyAsItTakesAtOnce) {
    for (const auto& [decode, frames] : {std::pair{0ms, 2U}, {10ms, 2U}, {40ms, 4U}}) {
        CreditWindow window;
        TimePoint now{1s};
        uint64_t sent = 0;
        uint64_t acked = 0;
        std::deque<TimePoint> painted; // of those under way: 2 ms there and back, then decoding
        for (int step = 0; step < 4000; ++step, now += 1ms) {
            while (!painted.empty() && painted.front() <= now) {
                painted.pop_front();
                window.onAck(++acked, now, decode, decode);
            }
            if (step % 16 == 0 && window.open()) {
                window.onProduced(16ms);
                window.onSent(++sent, now);
                painted.push_back(now + 2ms + decode);
            }
        }
        EXPECT_EQ(window.window(), frames) << decode.count();
        EXPECT_GE(sent, 4000U / 16 * 9 / 10) << "every frame leaves, however long decoding takes";
    }
}

TEST(CreditWindow, IdsNearTheEnd_StillWork) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(~0ULL - 1, now);
    window.onSent(~0ULL, now);
    EXPECT_EQ(window.onAck(~0ULL, now + 1ms), AckOutcome::kFresh);
    EXPECT_TRUE(window.open());
}

TEST(CreditWindow, WaitingForTheDisplay_IsNoQueue) {
    CreditWindow window;
    TimePoint now{1s};
    for (uint64_t id = 1; id < 100; ++id) {
        window.onProduced(16ms);
        window.onSent(id, now);
        if (id > 1) {
            window.onAck(id - 1, now + 3ms + std::chrono::milliseconds(id * 7 % 17));
        }
        now += 20ms;
        ASSERT_GE(window.window(), 2U);
    }
}

TEST(CreditWindow, Bursts_AreNoReasonToWidenBeyondWhatTheServerMakes) {
    CreditWindow window;
    TimePoint now{1s};
    for (uint64_t id = 1; id < 100; id += 2) {
        window.onProduced(100ms);
        window.onSent(id, now);
        window.onSent(id + 1, now);
        now += 60ms;
        window.onAck(id + 1, now);
        ASSERT_EQ(window.window(), 2U);
    }
}

TEST(CreditWindow, Bulk_SaysNothingOfTheLink) {
    CreditWindow window;
    TimePoint now{1s};
    for (uint64_t id = 1; id < 20; ++id) {
        window.onProduced(16ms);
        window.onSent(id, now, {1000, 0, false});
        now += 10ms;
        window.onAck(id, now);
    }
    const Seconds base = *window.baseRoundTrip();
    window.onSent(20, now, {500'000, 0, true});
    window.onSent(21, now + 1ms, {1000, 3, false});
    window.onAck(20, now + 900ms);
    EXPECT_FALSE(window.lastTrip()->measured);
    window.onAck(21, now + 901ms);
    EXPECT_FALSE(window.lastTrip()->measured) << "it waited behind the large one";
    EXPECT_EQ(window.lastTrip()->as.rung, 3U);
    EXPECT_EQ(window.baseRoundTrip(), base);
    EXPECT_EQ(window.window(), 2U);
}

TEST(CreditWindow, FramesBehindFramesBehindBulk_SayNothingEither) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(1, now, {.bytes = 1'000'000, .bulk = true});
    window.onSent(2, now);
    ASSERT_EQ(window.onAck(1, now + 100ms), AckOutcome::kFresh);
    window.onSent(3, now + 100ms); // behind the second, which was behind the first
    for (const uint64_t id : {2U, 3U}) {
        ASSERT_EQ(window.onAck(id, now + 120ms), AckOutcome::kFresh);
        EXPECT_FALSE(window.lastTrip()->measured) << id;
    }
    EXPECT_FALSE(window.baseRoundTrip());
    window.onSent(4, now + 200ms);
    ASSERT_EQ(window.onAck(4, now + 210ms), AckOutcome::kFresh);
    EXPECT_TRUE(window.lastTrip()->measured);
}

TEST(CreditWindow, ClientsOwnTime_IsNotTheLinks) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(1, now);
    window.onAck(1, now + 100ms, 70ms);
    EXPECT_NEAR(window.lastTrip()->round_trip.count(), 0.03, 1e-9);
    window.onSent(2, now + 200ms);
    window.onAck(2, now + 240ms, 50ms);
    EXPECT_NEAR(window.lastTrip()->round_trip.count(), 0.04, 1e-9) << "more than there was";
    EXPECT_NEAR(window.lastTrip()->queue.count(), 0.01, 1e-9);
}

TEST(CreditWindow, ShutWindow_IsTold) {
    CreditWindow window;
    const TimePoint now{1s};
    window.onSent(1, now);
    window.onSent(2, now + 10ms);
    window.onAck(1, now + 50ms);
    window.onSent(3, now + 60ms); // shut from 10 to 50 ms, of 50
    window.onAck(2, now + 70ms);
    window.onAck(3, now + 120ms);
    EXPECT_NEAR(window.lastTrip()->held, 0.8, 1e-9);
    EXPECT_EQ(window.lastTrip()->ahead, 1U);
    EXPECT_NEAR(window.lastTrip()->interval.count(), 0.05, 1e-9);
}

TEST(CreditWindow, Floor_KeepsTwoOnASlowLinkAndProbesAlone) {
    CreditWindow window;
    window.setFloor(2);
    TimePoint now{1s};
    uint64_t acked = 0;
    uint64_t sent = 0;
    TimePoint free = now;
    bool alone = false;
    for (int i = 0; i < 100; ++i) {
        window.onProduced(16ms);
        while (window.open()) {
            window.onSent(++sent, now);
        }
        alone = alone || window.inFlight() == 1;
        free = std::max(free, now) + 200ms;
        now = free;
        window.onAck(++acked, now);
        ASSERT_GE(window.window(), 1U);
    }
    EXPECT_TRUE(alone) << "the base is measured afresh now and then";
    EXPECT_GE(window.window(), 1U);
}

// One link and one viewer, in steps of a millisecond: frames cost `cost` to make, take turns on
// the link for `serial` each, and their acknowledgements arrive `travel` after that.
struct Link {
    Seconds cost;
    Seconds serial;
    Seconds travel;
};

class Simulation {
  public:
    void run(const Link& link, Seconds duration) {
        const auto steps = static_cast<int>(duration / 1ms);
        for (int i = 0; i < steps; ++i) {
            step(link);
        }
    }
    [[nodiscard]] uint32_t window() const { return window_.window(); }
    // Since the last call.
    Seconds takeWorstAge() { return std::exchange(worst_age_, Seconds(0)); }
    Seconds takeMeanAge() {
        const Seconds mean = age_sum_ / static_cast<double>(delivered_);
        age_sum_ = Seconds(0);
        delivered_ = 0;
        return mean;
    }
    uint64_t takeDelivered() { return std::exchange(delivered_, 0); }
    [[nodiscard]] uint32_t takeLargestWindow() { return std::exchange(largest_window_, 0); }

  private:
    struct Travelling {
        uint64_t id;
        Seconds sent;
        Seconds acked;
    };
    [[nodiscard]] TimePoint at(Seconds time) const {
        return TimePoint(10s) + std::chrono::duration_cast<Clock::duration>(time);
    }
    void step(const Link& link) {
        now_ += Seconds(0.001);
        while (!travelling_.empty() && travelling_.front().acked <= now_) {
            const Seconds age = now_ - travelling_.front().sent;
            worst_age_ = std::max(worst_age_, age);
            age_sum_ += age;
            EXPECT_EQ(window_.onAck(travelling_.front().id, at(now_)), AckOutcome::kFresh);
            travelling_.pop_front();
            ++delivered_;
        }
        largest_window_ = std::max(largest_window_, window_.window());
        if (now_ >= made_ && window_.open()) {
            window_.onProduced(link.cost);
            window_.onSent(++id_, at(now_));
            link_free_ = std::max(link_free_, now_) + link.serial;
            travelling_.push_back({id_, now_, link_free_ + link.travel});
            made_ = now_ + link.cost;
        }
    }

    CreditWindow window_;
    Seconds now_{0};
    Seconds made_{0};
    Seconds link_free_{0};
    Seconds worst_age_{0};
    Seconds age_sum_{0};
    uint64_t id_ = 0;
    uint64_t delivered_ = 0;
    uint32_t largest_window_ = 0;
    std::deque<Travelling> travelling_;
};

TEST(CreditWindowOnALink, LongFatPipe_FillsIt) {
    Simulation simulation;
    const Link link{16ms, 2ms, 100ms};
    simulation.run(link, 5s);
    EXPECT_EQ(simulation.window(), CreditWindow::kMax);
    simulation.takeDelivered();
    simulation.run(link, 10s);
    EXPECT_GT(simulation.takeDelivered(), 560U); // of 625 that the server could make
}

TEST(CreditWindowOnALink, Loopback_StaysAtTwo) {
    Simulation simulation;
    simulation.run({16ms, 0ms, 1ms}, 5s);
    EXPECT_EQ(simulation.takeLargestWindow(), 2U);
}

TEST(CreditWindowOnALink, SlowServer_StaysAtTwo) {
    Simulation simulation;
    simulation.run({120ms, 1ms, 60ms}, 20s);
    EXPECT_EQ(simulation.takeLargestWindow(), 2U);
}

TEST(CreditWindowOnALink, SlowLink_GivesFreshFrames) {
    Simulation simulation;
    const Link link{16ms, 400ms, 10ms}; // a 100 kB frame at 2 Mbit/s
    simulation.run(link, 10s);
    EXPECT_LE(simulation.takeLargestWindow(), 2U);
    simulation.takeWorstAge();
    simulation.takeMeanAge();
    simulation.run(link, 60s);
    EXPECT_LT(simulation.takeWorstAge(), Seconds(0.9)); // never more than one frame waits
    EXPECT_LT(simulation.takeMeanAge(), Seconds(0.5));  // mostly none: 0.41 s is the link's own
    simulation.run(link, 60s);
    EXPECT_GT(simulation.takeDelivered(), 130U); // of 150 that the link can carry
}

TEST(CreditWindowOnALink, LinkGetsSlower_WindowShrinksAtOnce) {
    Simulation simulation;
    simulation.run({16ms, 2ms, 100ms}, 5s);
    EXPECT_EQ(simulation.window(), CreditWindow::kMax);
    const Link slower{16ms, 200ms, 100ms};
    simulation.run(slower, 6s); // well before the base round trip is measured afresh
    EXPECT_LE(simulation.window(), 2U);
    simulation.takeWorstAge();
    simulation.run(slower, 60s);
    EXPECT_LT(simulation.takeWorstAge(), Seconds(0.9));
}

TEST(CreditWindowOnALink, LongerRoute_IsLearntAfresh) {
    Simulation simulation;
    simulation.run({16ms, 1ms, 20ms}, 5s);
    const Link longer{16ms, 1ms, 100ms};
    simulation.run(longer, 30s);
    simulation.takeDelivered();
    simulation.run(longer, 10s);
    EXPECT_GT(simulation.takeDelivered(), 500U);
}

TEST(CreditWindow, RandomUse_KeepsItsBounds) {
    std::mt19937 random(3);
    CreditWindow window;
    TimePoint now{1s};
    uint64_t sent = 0;
    uint64_t acked = 0;
    for (int i = 0; i < 200'000; ++i) {
        now += std::chrono::microseconds(random() % 30'000);
        switch (random() % 4) {
        case 0:
            window.onProduced(Seconds(static_cast<double>(random() % 100) * 1e-3));
            break;
        case 1:
            acked += random() % 3;
            window.onAck(acked, now);
            break;
        default:
            if (window.open()) {
                window.onSent(++sent, now);
            }
        }
        ASSERT_GE(window.window(), 1U);
        ASSERT_LE(window.window(), CreditWindow::kMax);
        ASSERT_LE(window.inFlight(), CreditWindow::kMax);
        acked = std::min(acked, sent);
    }
    EXPECT_GT(sent, 1000U);
}

} // namespace
} // namespace froxel::session
