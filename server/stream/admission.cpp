#include "stream/admission.h"

#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace froxel::stream {
namespace {

// What a rate is told from at least; a lone frame then counts as 100 a second.
constexpr Seconds kShortest{0.01};

std::string rounded(double value) {
    return numberText(std::round(value * 100) / 100);
}

} // namespace

void Admission::setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost) {
    min_rate_hz_ = min_rate_hz;
    if (frame_cost) {
        typical_cost_.add(*frame_cost);
    }
}

void Admission::add(uint64_t session, TimePoint now) {
    sessions_[session].expected_since = now;
}

void Admission::setTakesFrames(uint64_t session, bool takes, TimePoint now) {
    const auto found = sessions_.find(session);
    if (found != sessions_.end()) {
        auto& since = found->second.expected_since;
        since = !takes ? std::nullopt : since ? since : std::optional(now);
    }
}

void Admission::remove(uint64_t session) {
    sessions_.erase(session);
}

void Admission::onFrame(uint64_t session, Seconds cost, TimePoint now) {
    const auto found = sessions_.find(session);
    if (found == sessions_.end()) {
        return;
    }
    Entry& entry = found->second;
    entry.cost.add(cost);
    typical_cost_.add(cost);
    const Seconds age = now - entry.window_begin;
    if (age >= kWindow) {
        entry.before_count = age < 2 * kWindow ? entry.window_count : 0;
        entry.window_begin = now;
        entry.window_count = 0;
    }
    ++entry.window_count;
}

// Over the window that ends now: all of the present one, and of the one before it the part that
// reaches into it. One that has just begun to draw is taken at the rate at which it began.
double Admission::rateOf(const Entry& entry, TimePoint now) {
    const Seconds age = now - entry.window_begin;
    if (age >= 2 * kWindow) {
        return 0;
    }
    if (entry.before_count == 0 && age < kWindow) {
        return entry.window_count / std::max(age, kShortest).count();
    }
    const double here = age < kWindow ? entry.window_count : 0;
    const double before = age < kWindow ? entry.before_count : entry.window_count;
    const Seconds reach = age < kWindow ? kWindow - age : 2 * kWindow - age;
    return (here + before * (reach / kWindow)) / kWindow.count();
}

Admission::Needs Admission::needs(TimePoint now) const {
    Needs needs;
    double cost_sum_s = 0;
    uint32_t drawing = 0;
    uint32_t unknown = 0;
    for (const auto& [id, entry] : sessions_) {
        const auto cost = entry.cost.value();
        if (!cost) {
            const bool expected = entry.expected_since && now - *entry.expected_since < kPatience;
            unknown += expected ? 1U : 0U;
            continue;
        }
        const double rate_hz = rateOf(entry, now);
        if (rate_hz > 0) {
            ++drawing;
            cost_sum_s += cost->count();
            needs.busy += cost->count() * std::min(rate_hz, min_rate_hz_);
        }
    }
    const auto typical = typical_cost_.value();
    needs.mean_s = drawing > 0 ? cost_sum_s / drawing : typical.value_or(Seconds(0)).count();
    needs.one_more = needs.mean_s * min_rate_hz_;
    needs.busy += unknown * needs.one_more;
    needs.active = drawing + unknown;
    return needs;
}

double Admission::load(TimePoint now) const {
    const Needs needs = this->needs(now);
    return needs.busy + needs.one_more > 1 && needs.active > 0 ? 1
           : needs.busy > 0                                    ? needs.busy / (1 - needs.one_more)
                                                               : 0;
}

Result<void> Admission::check(TimePoint now) const {
    const Needs needs = this->needs(now);
    if (needs.active == 0 || needs.busy + needs.one_more <= 1) {
        return {};
    }
    return Error{ErrorCode::kCapacity,
                 "the device is busy: " + numberText(needs.active) + " active sessions need " +
                     rounded(needs.busy) + " of its time for " + rounded(min_rate_hz_) +
                     " frames a second each, and one more at " + rounded(needs.mean_s * 1e3) +
                     " ms a frame would pass 1; try again later"};
}

} // namespace froxel::stream
