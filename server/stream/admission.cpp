#include "stream/admission.h"

#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace froxel::stream {
namespace {

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
    entry.seen = now;
}

void Admission::setTakesFrames(uint64_t session, bool takes, TimePoint now) {
    const auto found = sessions_.find(session);
    if (found != sessions_.end() && found->second.takes_frames != takes) {
        found->second.takes_frames = takes;
        found->second.seen = now;
    }
}

void Admission::remove(uint64_t session) {
    sessions_.erase(session);
}

void Admission::onFrame(uint64_t session, Seconds cost, TimePoint now, bool reused) {
    const auto found = sessions_.find(session);
    if (found != sessions_.end()) {
        Entry& entry = found->second;
        (reused ? entry.reused : entry.moving).add(cost);
        entry.seen = now;
    }
}

Seconds Admission::costOf(const Entry& entry) const {
    const bool known = entry.moving.steady() || newcomer_cost_ == Seconds(0);
    const auto moving = known ? entry.moving.value() : std::nullopt;
    return std::max(moving.value_or(newcomer_cost_), entry.reused.value().value_or(Seconds(0)));
}

Admission::Needs Admission::needs(TimePoint now) const {
    Needs needs;
    needs.one_more = newcomer_cost_.count() * min_rate_hz_;
    for (const auto& [id, entry] : sessions_) {
        if (entry.takes_frames && now - entry.seen < kForgotten) {
            ++needs.active;
            needs.accounts[entry.account] += costOf(entry).count() * min_rate_hz_;
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
    return Error{ErrorCode::kCapacity,
                 "the device is busy: " + numberText(needs.active) + " sessions may need " +
                     rounded(busy) + " of its time for " + rounded(min_rate_hz_) +
                     " frames a second each, and one more at " +
                     rounded(newcomer_cost_.count() * 1e3) + " ms a frame would pass 1"};
}

} // namespace froxel::stream
