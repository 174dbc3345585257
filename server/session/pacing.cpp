#include "session/pacing.h"

#include <algorithm>
#include <cmath>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

// A base round trip that no later one has come near for this long is not believed any more (the
// route may have changed); a lone frame then measures it afresh.
constexpr Seconds kBaseLifetime = 10s;
// Near: within a quarter, or within a refresh of the client's display, for which a picture may
// wait.
constexpr double kNear = 1.25;
constexpr Seconds kJitter = 20ms;
// Frames that wait on the way, by Vegas' measure window * (1 - base / round trip): below the
// first the pipe has room, above the second it queues. Two frames on a link that is all bandwidth
// and no distance give just under 1.
constexpr double kRoom = 0.5;
constexpr double kQueueing = 0.75;
// How long a window that made frames queue is not tried again: without it a slow link would swing
// between one frame and two.
constexpr Seconds kMinHold = 2s;
constexpr double kHoldRoundTrips = 8;
// Weight of the newest frame in the smoothed cost.
constexpr double kCostWeight = 0.125;

bool isNear(Seconds round_trip, Seconds base) {
    return round_trip <= base * kNear || round_trip <= base + kJitter;
}

} // namespace

void CreditWindow::onProduced(Seconds cost) {
    cost_ = cost_ ? *cost_ + (cost - *cost_) * kCostWeight : cost;
}

void CreditWindow::onSent(uint64_t frame_id, TimePoint now) {
    sent_.push_back({frame_id, now, inFlight()});
    last_sent_id_ = frame_id;
}

AckOutcome CreditWindow::onAck(uint64_t frame_id, TimePoint now) {
    if (frame_id == 0 || frame_id > last_sent_id_) {
        return AckOutcome::kUnknown;
    }
    std::optional<Sent> acknowledged;
    while (!sent_.empty() && sent_.front().frame_id <= frame_id) {
        acknowledged = sent_.front();
        sent_.pop_front();
    }
    if (!acknowledged) {
        return AckOutcome::kStale;
    }
    takeSample(*acknowledged, now);
    return AckOutcome::kFresh;
}

Seconds CreditWindow::stalledFor(TimePoint now) const {
    return sent_.empty() ? Seconds(0) : Seconds(now - sent_.front().at);
}

void CreditWindow::takeSample(const Sent& frame, TimePoint now) {
    const Seconds round_trip = now - frame.at;
    if (probing_) {
        if (frame.ahead > 0) {
            return; // sent before the probe; it had company
        }
        probing_ = false;
        window_ = kInitial;
        base_.reset();
    }
    if (!base_ || round_trip < *base_) {
        base_ = round_trip;
        base_confirmed_at_ = now;
    } else if (isNear(round_trip, *base_)) {
        base_confirmed_at_ = now;
    } else if (now - base_confirmed_at_ > kBaseLifetime) {
        probing_ = true;
        window_ = 1;
        return;
    }
    adjust(round_trip, frame, now);
}

void CreditWindow::adjust(Seconds round_trip, const Sent& frame, TimePoint now) {
    if (frame.frame_id <= adjusted_at_id_) {
        return;
    }
    const double company = frame.ahead + 1.0;
    const double waiting =
        isNear(round_trip, *base_) ? 0 : company * (1 - base_->count() / round_trip.count());
    const bool was_full = frame.ahead + 1 >= window_;
    if (waiting >= kQueueing && window_ > 1) {
        // All that wait at once: step by step would take as many of the long round trips.
        window_ -= std::clamp(static_cast<uint32_t>(waiting), 1U, window_ - 1);
        const Seconds hold = std::max(kMinHold, kHoldRoundTrips * round_trip);
        grow_after_ = now + std::chrono::duration_cast<Clock::duration>(hold);
    } else if (waiting < kRoom && was_full && window_ < target() && now >= grow_after_) {
        ++window_;
    } else if (window_ > target()) {
        --window_;
    } else {
        return;
    }
    adjusted_at_id_ = last_sent_id_;
}

uint32_t CreditWindow::target() const {
    if (!cost_ || !base_ || cost_->count() <= 0) {
        return kInitial;
    }
    const double frames = std::ceil(*base_ / *cost_) + 1;
    return static_cast<uint32_t>(std::clamp(frames, double{kInitial}, double{kMax}));
}

} // namespace froxel::session
