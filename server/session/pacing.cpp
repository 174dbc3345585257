#include "session/pacing.h"

#include <algorithm>
#include <cmath>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

// A base round trip that no later one has come near for this long is not believed any more (the
// route may have changed); a lone frame then measures it afresh.
constexpr Seconds kBaseLifetime = 10s;
// The same where the window may not shrink to a single frame, which would measure it by itself.
constexpr Seconds kBaseLifetimeAtFloor = 2s;
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
// Weight of the newest frame in the smoothed decoding time.
constexpr double kDecodeWeight = 0.125;

bool isNear(Seconds round_trip, Seconds base) {
    return round_trip <= base * kNear || round_trip <= base + kJitter;
}

} // namespace

void CreditWindow::onProduced(Seconds cost) {
    cost_.add(cost);
}

void CreditWindow::onSent(uint64_t frame_id, TimePoint now, const SentAs& as) {
    const bool behind_bulk = !sent_.empty() && !sent_.back().measured;
    sent_.push_back({frame_id, now, inFlight(), takeHeld(now), !as.bulk && !behind_bulk, as});
    last_sent_id_ = frame_id;
    if (!open()) {
        shut_at_ = now;
    }
}

double CreditWindow::takeHeld(TimePoint now) {
    const Seconds since = now - sent_at_;
    const Seconds shut = shut_ + (shut_at_ ? Seconds(now - *shut_at_) : Seconds(0));
    sent_at_ = now;
    shut_ = Seconds(0);
    shut_at_.reset();
    return since.count() > 0 ? std::min(1.0, shut / since) : 0;
}

AckOutcome CreditWindow::onAck(uint64_t frame_id, TimePoint now, Seconds client, Seconds decode) {
    if (frame_id == 0 || frame_id > last_sent_id_) {
        return AckOutcome::kUnknown;
    }
    std::optional<Sent> acknowledged;
    uint32_t count = 0;
    while (!sent_.empty() && sent_.front().frame_id <= frame_id) {
        acknowledged = sent_.front();
        sent_.pop_front();
        ++count;
    }
    if (!acknowledged) {
        return AckOutcome::kStale;
    }
    const Seconds whole = now - acknowledged->at;
    const Seconds round_trip = client < whole ? whole - client : whole;
    decode_ += (std::min(decode, client) - decode_) * kDecodeWeight;
    if (acknowledged->measured) {
        takeSample(*acknowledged, round_trip, now);
    }
    trip_ = Trip{acknowledged->as,
                 round_trip,
                 std::max(Seconds(0), round_trip - expected(acknowledged->as.bytes)),
                 Seconds(now - acked_at_) / count,
                 acknowledged->ahead,
                 acknowledged->measured,
                 acknowledged->held,
                 window_ < target() && now >= grow_after_};
    acked_at_ = now;
    if (shut_at_ && open()) {
        shut_ += now - *shut_at_;
        shut_at_.reset();
    }
    return AckOutcome::kFresh;
}

void CreditWindow::setFloor(uint32_t floor) {
    floor_ = floor;
    window_ = probing_ ? window_ : std::max(window_, floor_);
}

void CreditWindow::probe() {
    probing_ = true;
    window_ = 1;
}

void CreditWindow::takeSample(const Sent& frame, Seconds round_trip, TimePoint now) {
    if (probing_) {
        if (frame.ahead > 0) {
            return; // sent before the probe; it had company
        }
        probing_ = false;
        window_ = kInitial;
        base_.reset();
        grow_after_ = now;
    }
    if (!base_ || round_trip < *base_) {
        base_ = round_trip;
        base_bytes_ = frame.as.bytes;
        base_confirmed_at_ = now;
    } else if (isNear(round_trip, expected(frame.as.bytes))) {
        base_confirmed_at_ = now;
    } else if (now - base_confirmed_at_ > (floor_ > 1 ? kBaseLifetimeAtFloor : kBaseLifetime)) {
        probe();
        return;
    }
    adjust(round_trip, frame, now);
}

// A larger frame may take as much longer as it is larger: generous where distance, not the link's
// rate, makes most of the base.
Seconds CreditWindow::expected(size_t bytes) const {
    const double larger =
        static_cast<double>(bytes) / static_cast<double>(std::max(base_bytes_, size_t{1}));
    return base_ ? *base_ * std::max(1.0, larger) : Seconds(0);
}

void CreditWindow::adjust(Seconds round_trip, const Sent& frame, TimePoint now) {
    if (frame.frame_id <= adjusted_at_id_) {
        return;
    }
    const Seconds base = expected(frame.as.bytes);
    const double company = frame.ahead + 1.0;
    const double waiting =
        isNear(round_trip, base) ? 0 : company * (1 - base.count() / round_trip.count());
    const bool was_full = frame.ahead + 1 >= window_;
    if (waiting >= kQueueing && window_ >= floor_ && window_ > 1) {
        // All that wait at once: step by step would take as many of the long round trips.
        window_ -= std::clamp(static_cast<uint32_t>(waiting), 1U, window_ - 1);
        window_ = std::max(window_, floor_);
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
    const Seconds cost = cost_.value().value_or(Seconds(0));
    if (!base_ || cost.count() <= 0) {
        return kInitial;
    }
    const double frames = std::ceil((*base_ + decode_) / cost) + 1;
    return static_cast<uint32_t>(std::clamp(frames, double{kInitial}, double{kMax}));
}

} // namespace froxel::session
