#include "session/rate_controller.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

// Trips that agree before anything is believed of the link.
constexpr size_t kEvidence = 4;
constexpr size_t kTelling = 2; // of which that show what the link takes for a frame
// The window is shut for more than this share of the time: credit, not the server, sets the pace.
// Not for all of it even where a link is far too slow, since the server makes a frame only while
// the window is open.
constexpr double kHeld = 0.1;
// Frames wait on the link for at least this share of what it takes for one.
constexpr double kWaiting = 0.25;
// How much of the wanted interval the link may need for a frame, where frames wait; and after a
// step up.
constexpr double kBusy = 0.9;
constexpr double kRoomy = 0.75;
// A trip this late is believed by itself where frames are this much further apart than wanted.
constexpr Seconds kAlarm = 250ms;
constexpr double kAlarmRatio = 3;
// Between two steps up, so that frames of the last one are there to judge by; to a rung that failed
// before, once the one below has held for a while.
constexpr Seconds kClimb = 200ms;
constexpr Seconds kClimbAgain = 2s;
// How long a rung that failed is not tried again, at first and at most; doubled in between.
constexpr Seconds kFirstHold = 8s;
constexpr Seconds kLongestHold = 128s;
// After this long without a step down, failures at this rung and below are forgotten.
constexpr Seconds kStable = 20s;
// Frames at a rung before their travel counts as settled, and what is a clear change of it: of lone
// frames' round trips against the wanted interval, of the link's time a frame against what it was.
constexpr uint32_t kSettled = 6;
constexpr Seconds kMinFaster = 8ms;
constexpr double kFaster = 0.25;
constexpr double kFasterLink = 0.4;
// The same of the rate, against that at which a rung failed.
constexpr double kCarriesMore = 1.5;
// A lone frame that travels nearly as long as frames in company did: distance, not queue.
constexpr double kAsLong = 0.75;
constexpr Seconds kDoubtful = 2s; // a lone frame later than this proves nothing
// For so long after it the base round trip is fresh, and frames that wait do wait.
constexpr Seconds kSure = 10s;
constexpr double kFastWeight = 1.0 / 3;
constexpr double kSlowWeight = 1.0 / 16;
// A rate that was seen is believed for so long where frames wait though less gets through.
constexpr Seconds kRateLifetime = 10s;
// What the rate of frames in company is taken over: acknowledgements come in bunches, as a display
// refreshes.
constexpr Seconds kRateSpan = 50ms;

} // namespace

void RateController::restart(const settings::Encoding& encoding, const DeliverySettings& settings) {
    asked_ = encoding;
    settings_ = settings;
    ladder_ = makeLadder(encoding);
    failures_.assign(ladder_.size(), {});
    doubt_.reset();
    moveTo(0, moved_at_);
}

void RateController::setWanted(const settings::Encoding& encoding,
                               const DeliverySettings& settings) {
    if (encoding == asked_ && settings == settings_) {
        return;
    }
    const Delivery before = delivery();
    const settings::Encoding as = limited(asked_, before);
    // Bits of one codec say nothing about those of another.
    const bool stay = rung_ > 0 && settings.adaptive && encoding.codec == asked_.codec;
    restart(encoding, settings);
    if (!stay) {
        return;
    }
    // The first rung that asks no more of the link than the one before the change did.
    const auto no_more = [&](const Rung& rung) {
        const settings::Encoding now = limited(encoding, rung.delivery);
        return rung.delivery.scale <= before.scale && now.quality <= as.quality &&
               now.chroma <= as.chroma && now.video_kbps <= as.video_kbps &&
               rung.delivery.min_interval >= before.min_interval;
    };
    const auto found = std::find_if(ladder_.begin(), ladder_.end(), no_more);
    rung_ =
        found == ladder_.end() ? static_cast<uint32_t>(ladder_.size() - 1) : found->delivery.rung;
}

void RateController::onProduced(Seconds cost, double scale) {
    cost_.add(cost);
    if (scale >= 1) {
        full_cost_.add(cost);
    }
}

Seconds RateController::wantedInterval() const {
    const double fps = settings_.target_fps > 0 ? settings_.target_fps : kEnoughFps;
    Seconds interval = std::max(Seconds(1 / fps), delivery().min_interval);
    // A smaller picture is no reason to ask for more frames than the full one would have.
    for (const SteadyCost& cost : {cost_, full_cost_}) {
        interval = std::max(interval, cost.value().value_or(Seconds(0)));
    }
    return interval;
}

double RateController::demand(size_t rung) const {
    const Seconds own = ladder_[rung].delivery.min_interval;
    const Seconds now = delivery().min_interval;
    const Seconds wanted = wantedInterval();
    const Seconds interval = own > now ? std::max(own, wanted) : wanted;
    return ladder_[rung].bits / interval.count();
}

RateStep RateController::onTrip(const Trip& trip, TimePoint now) {
    noteRate(trip, now);
    if (!trip.measured) {
        return RateStep::kNone;
    }
    queue_ += (trip.queue - queue_) * kFastWeight;
    if (!settings_.adaptive) {
        return RateStep::kNone;
    }
    if (doubt_ && trip.ahead == 0 && now - moved_at_ < kDoubtful) {
        const Doubt doubt = *std::exchange(doubt_, std::nullopt);
        if (trip.round_trip > kAsLong * doubt.round_trip) {
            failures_ = doubt.failures;
            failures_[doubt.rung] = {};
            sure_until_ = now + std::chrono::duration_cast<Clock::duration>(kSure);
            moveTo(doubt.rung, now);
            return RateStep::kUndone;
        }
    }
    if (trip.as.rung != rung_) {
        return RateStep::kNone; // says nothing about the present one
    }
    ++seen_;
    recent_.push_back(trip);
    if (recent_.size() > kEvidence) {
        recent_.pop_front();
    }
    noteTravel(trip);
    if (const auto link_interval = overload()) {
        if (rung_ + 1 < ladder_.size()) {
            stepDown(*link_interval, now);
            return RateStep::kCongested;
        }
        return RateStep::kNone;
    }
    if (now - moved_at_ > kStable) {
        std::fill(failures_.begin() + rung_, failures_.end(), Failure{});
    }
    if (roomAbove(now)) {
        moveTo(rung_ - 1, now);
        return RateStep::kRecovered;
    }
    return RateStep::kNone;
}

// Frames in company show what the link takes for each; a lone one shows it with the way added,
// which is less than the link's rate and all that is known.
void RateController::noteRate(const Trip& trip, TimePoint now) {
    const bool company = trip.ahead > 0;
    if (!company) {
        rate_bits_ = 0;
        rate_took_ = Seconds(0);
    }
    rate_bits_ += 8.0 * static_cast<double>(trip.as.bytes);
    rate_took_ += company ? trip.interval : trip.round_trip;
    if (rate_took_ < (company ? kRateSpan : Seconds(1us))) {
        return;
    }
    const double rate = std::exchange(rate_bits_, 0) / std::exchange(rate_took_, 0s).count();
    const bool bottleneck = company && trip.held > kHeld && !trip.growing;
    // Frames that wait for nothing say only what was asked of the link.
    const bool waits = bottleneck || trip.queue > kWaiting * trip.round_trip;
    const bool old = waits && now - link_rate_at_ > kRateLifetime;
    if (!link_rate_ || old || rate >= *link_rate_) {
        link_rate_ = rate;
        link_rate_at_ = now;
    } else if (bottleneck) {
        *link_rate_ += (rate - *link_rate_) * kFastWeight;
        link_rate_at_ = now;
    }
}

// Frames that travel faster than they did: what failed then may do now.
void RateController::noteTravel(const Trip& trip) {
    const bool lone = trip.ahead == 0;
    if (!lone && !heldBack()) {
        return; // acknowledgements come as the server makes frames
    }
    const Seconds took = lone ? trip.round_trip : trip.interval;
    if (++paced_ <= kSettled) {
        pace_fast_ = pace_slow_ = took;
        return;
    }
    pace_fast_ += (took - pace_fast_) * kFastWeight;
    pace_slow_ += (took - pace_slow_) * kSlowWeight;
    const Seconds clear = lone ? kFaster * wantedInterval() : kFasterLink * pace_slow_;
    if (pace_slow_ - pace_fast_ > std::max(kMinFaster, clear)) {
        pace_slow_ = pace_fast_;
        std::fill(failures_.begin(), failures_.end(), Failure{});
    }
    for (Failure& failure : failures_) {
        if (carried() > kCarriesMore * failure.link_rate) {
            failure = {};
        }
    }
}

// Bits a second that frames of late got through, each by itself or all together: at most the
// link's.
double RateController::carried() const {
    double bits = 0;
    Seconds took{0};
    for (const Trip& trip : recent_) {
        bits += 8.0 * static_cast<double>(trip.as.bytes);
        took += trip.ahead > 0 ? trip.interval : trip.round_trip;
    }
    return took.count() > 0 ? bits / took.count() : 0;
}

bool RateController::heldBack() const {
    const double held =
        std::accumulate(recent_.begin(), recent_.end(), 0.0,
                        [](double sum, const Trip& trip) { return sum + trip.held; });
    return held > kHeld * static_cast<double>(recent_.size());
}

// What the link took for a frame: where it had company, at most the time between acknowledgements;
// the least of several, since frames that distance alone keeps apart come in bunches.
std::optional<Seconds> RateController::overload() const {
    const Seconds wanted = wantedInterval();
    const auto took = [this](const Trip& trip) {
        return alone() ? trip.round_trip : std::min(trip.interval, trip.round_trip);
    };
    const auto tells = [this](const Trip& trip) { return trip.ahead > 0 || alone(); };
    const Trip& last = recent_.back();
    if (last.growing) {
        return {};
    }
    if (tells(last) && last.held > kHeld && last.queue > kAlarm &&
        took(last) > kAlarmRatio * wanted) {
        return took(last);
    }
    size_t count = 0;
    Seconds least = took(last);
    Seconds waited{0};
    for (const Trip& trip : recent_) {
        waited += trip.queue / static_cast<double>(recent_.size());
        if (tells(trip)) {
            least = std::min(least, took(trip));
            ++count;
        }
    }
    const bool enough = recent_.size() == kEvidence && count >= kTelling && heldBack();
    return enough && least > kBusy * wanted && waited > kWaiting * least ? std::optional(least)
                                                                         : std::nullopt;
}

// Mean of the frames that others were ahead of.
Seconds RateController::companysRoundTrip() const {
    Seconds sum{0};
    double count = 0;
    for (const Trip& trip : recent_) {
        if (trip.ahead > 0) {
            sum += trip.round_trip;
            ++count;
        }
    }
    return count > 0 ? sum / count : Seconds(0);
}

bool RateController::roomAbove(TimePoint now) const {
    if (rung_ == 0 || seen_ < kEvidence) {
        return false;
    }
    const Failure& above = failures_[rung_ - 1];
    const Seconds dwell = above.held_until == TimePoint() ? kClimb : kClimbAgain;
    if (now - moved_at_ < dwell || now < above.held_until) {
        return false;
    }
    const Seconds wanted = wantedInterval();
    if (queue_ > std::max(Seconds(20ms), wanted / 2)) {
        return false;
    }
    // Where credit holds frames back, what the link takes for one is known.
    const Trip& last = recent_.back();
    const double more = demand(rung_ - 1) / demand(rung_);
    return !heldBack() || (last.ahead > 0 && last.interval * more < kRoomy * wanted);
}

void RateController::stepDown(Seconds link_interval, TimePoint now) {
    const auto last = static_cast<uint32_t>(ladder_.size() - 1);
    const double bearable =
        demand(rung_) * std::min(1.0, kBusy * (wantedInterval() / link_interval));
    uint32_t next = rung_ + 1;
    while (next < last && demand(next) > bearable) {
        ++next;
    }
    if (!alone() && now >= sure_until_) {
        doubt_ = Doubt{rung_, companysRoundTrip(), failures_};
        probe_ = true;
    }
    Failure& failure = failures_[rung_];
    const double doubled = std::exp2(std::min(failure.count, 8U));
    ++failure.count;
    const Seconds hold = std::min(kLongestHold, kFirstHold * doubled);
    failure.link_rate = carried();
    failure.held_until = now + std::chrono::duration_cast<Clock::duration>(hold);
    // What asks for more, or was left out on the way down, is not to be tried sooner.
    for (uint32_t above = 0; above < next; ++above) {
        Failure& held = failures_[above];
        held.held_until = std::max(held.held_until, failure.held_until);
        held.link_rate = held.count > 0 ? held.link_rate : failure.link_rate;
    }
    moveTo(next, now);
}

void RateController::moveTo(uint32_t rung, TimePoint now) {
    rung_ = rung;
    moved_at_ = now;
    recent_.clear();
    seen_ = 0;
    paced_ = 0;
}

} // namespace froxel::session
