// A server, a link and a client in steps of a millisecond: frames take `cost` to make, turns on the
// link by their size, and a way there and back. The server is the real credit window and rate
// controller, with the slot before the socket as a connection has it.
#pragma once

#include "session/rate_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <random>
#include <vector>

namespace froxel::session {

struct SimulatedLink {
    Seconds cost{0.06};          // of a full frame; of a smaller one, by its area
    double bytes_per_s = 1e9;    // of the link
    Seconds travel{0.002};       // there and back
    Seconds jitter{0};           // at most, of an acknowledgement; order is kept
    Seconds client{0};           // from receiving to painting
    bool client_tells = true;    // its acknowledgements say so
    double frame_bytes = 25'000; // of a full frame
    double noise = 0.1;          // of its size, either way
    double wander = 0;           // likewise, slowly: by what is seen as a camera circles
    Seconds first_cost{0};       // of the very first frame, which compiles
    Seconds refresh{0};          // acknowledgements wait for the next of these; 0: for nothing
};

class Simulation {
  public:
    struct Shown {
        Seconds at;
        Seconds age; // from the start of making it
        uint32_t rung;
    };

    explicit Simulation(settings::Encoding asked = {75, settings::Chroma::k420}, uint32_t seed = 1)
        : random_(seed) {
        rate_.setWanted(asked, {});
        ladder_ = makeLadder(asked);
    }

    // What was shown meanwhile.
    std::vector<Shown> run(const SimulatedLink& link, Seconds duration) {
        shown_.clear();
        const auto steps = static_cast<int>(std::lround(duration.count() * 1000));
        for (int i = 0; i < steps; ++i) {
            step(link);
        }
        return shown_;
    }
    RateController& rate() { return rate_; }
    [[nodiscard]] Seconds now() const { return now_; }
    [[nodiscard]] const std::vector<RateStep>& steps() const { return steps_; }
    void forgetSteps() { steps_.clear(); }
    [[nodiscard]] std::ptrdiff_t count(RateStep step) const {
        return std::count(steps_.begin(), steps_.end(), step);
    }

  private:
    struct Frame {
        uint64_t id = 0;
        Seconds begun{0};
        Seconds done{0};
        uint32_t rung = 0;
        size_t bytes = 0;
    };
    struct Travelling {
        Frame frame;
        Seconds acked;
        Seconds client;
    };

    [[nodiscard]] TimePoint clock() const {
        return TimePoint(std::chrono::hours(1)) + std::chrono::duration_cast<Clock::duration>(now_);
    }
    double uniform(double from, double to) {
        return std::uniform_real_distribution(from, to)(random_);
    }

    void step(const SimulatedLink& link) {
        now_ += Seconds(0.001);
        while (!travelling_.empty() && travelling_.front().acked <= now_) {
            acknowledge(link);
        }
        if (making_ && making_->done <= now_) {
            const double scale = scaleOf(*making_);
            const Seconds cost = making_->done - making_->begun;
            window_.onProduced(cost);
            rate_.onProduced(cost, scale);
            slot_ = *std::exchange(making_, std::nullopt);
        }
        send(link);
        make(link);
        send(link);
    }
    void acknowledge(const SimulatedLink& link) {
        const Travelling arrived = travelling_.front();
        travelling_.pop_front();
        shown_.push_back({now_,
                          arrived.acked - arrived.client - link.travel / 2 - arrived.frame.begun,
                          arrived.frame.rung});
        EXPECT_EQ(window_.onAck(arrived.frame.id, clock(),
                                link.client_tells ? arrived.client : Seconds(0)),
                  AckOutcome::kFresh);
        const RateStep taken = rate_.onTrip(*window_.lastTrip(), clock());
        if (taken != RateStep::kNone) {
            steps_.push_back(taken);
        }
        window_.setFloor(rate_.alone() ? 1 : 2);
        if (rate_.takeProbe()) {
            window_.probe();
        }
    }
    void make(const SimulatedLink& link) {
        const bool room = window_.open() && !slot_;
        const uint32_t more =
            window_.window() - window_.inFlight() + (window_.window() > 1 ? 1 : 0);
        if (!room || more == 0 || making_ || now_ < next_due_) {
            return;
        }
        const Delivery& delivery = rate_.delivery();
        const double seen = 1 + link.wander * std::sin(now_.count());
        const double size =
            link.frame_bytes * bits() * seen * uniform(1 - link.noise, 1 + link.noise);
        making_ = Frame{++id_, now_, now_, delivery.rung, static_cast<size_t>(size)};
        const Seconds cost = link.cost * delivery.scale * delivery.scale;
        making_->done = now_ + (id_ == 1 ? std::max(cost, link.first_cost) : cost);
        scales_[id_ % 64] = delivery.scale;
        next_due_ = now_ + delivery.min_interval;
    }
    void send(const SimulatedLink& link) {
        if (!slot_ || !window_.open()) {
            return;
        }
        const Frame frame = *std::exchange(slot_, std::nullopt);
        window_.onSent(frame.id, clock(), {frame.bytes, frame.rung, false});
        link_free_ = std::max(link_free_, now_) +
                     Seconds(static_cast<double>(frame.bytes) / link.bytes_per_s);
        const Seconds last = travelling_.empty() ? Seconds(0) : travelling_.back().acked;
        const Seconds jitter = link.jitter * uniform(0, 1);
        Seconds acked = link_free_ + link.travel + link.client + jitter;
        if (link.refresh.count() > 0) {
            acked = std::ceil(acked / link.refresh) * link.refresh;
        }
        travelling_.push_back({frame, std::max(last, acked), link.client});
    }
    [[nodiscard]] double scaleOf(const Frame& frame) const { return scales_[frame.id % 64]; }
    [[nodiscard]] double bits() const { return ladder_[rate_.delivery().rung].bits; }

    std::mt19937 random_;
    std::vector<Rung> ladder_;
    CreditWindow window_;
    RateController rate_;
    Seconds now_{0};
    Seconds next_due_{0};
    Seconds link_free_{0};
    uint64_t id_ = 0;
    std::optional<Frame> making_;
    std::optional<Frame> slot_;
    std::array<double, 64> scales_{};
    std::deque<Travelling> travelling_;
    std::vector<Shown> shown_;
    std::vector<RateStep> steps_;
};

inline Seconds ageAt(std::vector<Simulation::Shown> shown, double quantile) {
    std::sort(shown.begin(), shown.end(), [](auto& a, auto& b) { return a.age < b.age; });
    const auto place = static_cast<size_t>(quantile * static_cast<double>(shown.size() - 1));
    return shown.at(place).age;
}

} // namespace froxel::session
