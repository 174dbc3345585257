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
    newcomer_cost_ = frame_cost.value_or(Seconds(0));
}

void Admission::add(uint64_t session, const session::Account& account, TimePoint now) {
    Entry& entry = sessions_[session];
    entry.account = account;
    entry.expected_since = now;
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
    needs.one_more = newcomer_cost_.count() * min_rate_hz_;
    for (const auto& [id, entry] : sessions_) {
        const auto cost = entry.cost.value();
        const double rate_hz = cost ? std::min(rateOf(entry, now), min_rate_hz_) : 0;
        const bool expected =
            !cost && entry.expected_since && now - *entry.expected_since < kPatience;
        if (rate_hz > 0 || expected) {
            ++needs.active;
            needs.accounts[entry.account] += cost ? cost->count() * rate_hz : needs.one_more;
        }
    }
    return needs;
}

double Admission::busyFor(const session::Account& account, const Needs& needs) {
    const auto newcomers = needs.accounts.contains(account) ? 0U : 1U;
    const double share = 1.0 / static_cast<double>(needs.accounts.size() + newcomers);
    double busy = 0;
    for (const auto& [other, need] : needs.accounts) {
        busy += other == account ? need : std::min(need, share);
    }
    return busy;
}

double Admission::load(TimePoint now) const {
    const Needs needs = this->needs(now);
    double busy = 0;
    for (const auto& [account, need] : needs.accounts) {
        busy = std::max(busy, busyFor(account, needs));
    }
    return busy <= 0 ? 0 : busy + needs.one_more > 1 ? 1 : busy / (1 - needs.one_more);
}

Result<void> Admission::check(const session::Account& account, TimePoint now) const {
    const Needs needs = this->needs(now);
    const double busy = busyFor(account, needs);
    if (needs.active == 0 || busy + needs.one_more <= 1) {
        return {};
    }
    return Error{ErrorCode::kCapacity, "the device is busy: " + numberText(needs.active) +
                                           " active sessions need " + rounded(busy) +
                                           " of its time for " + rounded(min_rate_hz_) +
                                           " frames a second each, and one more at " +
                                           rounded(newcomer_cost_.count() * 1e3) +
                                           " ms a frame would pass 1; try again later"};
}

} // namespace froxel::stream
