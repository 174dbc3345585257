#include "stream/frame_scheduler.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace froxel::stream {

namespace {

// Commands wait this long for their frame, so that one that comes a little late is still in it.
constexpr Seconds kInputLead{0.0015};
// In which the grid moves by an interval at most.
constexpr Seconds kMovePeriod{1.0};
// A piece waits for this part of its time for those who are behind. One that is ready later than
// that has half of its frames even where it is not waited for.
constexpr double kWorthWaiting = 0.5;
// Whoever was waited for in vain is taken to need this much longer, and what is left of a gap that
// could not be seen makes up for it: it is waited for again some pieces later.
constexpr double kWaitedInVain = 4;
constexpr double kGapDecay = 0.8;
// No address and no token is called so.
const session::Account kBeside{"beside the sessions"};

Clock::duration ticks(Seconds time) {
    return std::chrono::duration_cast<Clock::duration>(time);
}

} // namespace

FrameScheduler::Entry* FrameScheduler::find(uint64_t viewer) {
    const auto found = viewers_.find(viewer);
    return found != viewers_.end() ? &found->second : nullptr;
}

void FrameScheduler::add(uint64_t viewer, const session::Account& account) {
    enter(viewer, account);
}

void FrameScheduler::addBeside(uint64_t viewer) {
    enter(viewer, kBeside).beside = true;
}

FrameScheduler::Entry& FrameScheduler::enter(uint64_t viewer, const session::Account& account) {
    const auto [share, is_new] = accounts_.try_emplace(account);
    if (is_new) {
        share->second.virtual_time = virtual_now_;
    }
    ++share->second.viewer_count;
    Entry entry;
    entry.account = share;
    entry.virtual_time = std::max(share->second.virtual_now, share->second.left_behind);
    return viewers_.insert_or_assign(viewer, entry).first->second;
}

void FrameScheduler::remove(uint64_t viewer) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) {
        return;
    }
    const auto account = found->second.account;
    Share& share = account->second;
    share.left_behind = std::max(share.left_behind, found->second.virtual_time);
    --share.viewer_count;
    viewers_.erase(found);
    if (idle_for_ == viewer) {
        idle_for_.reset();
    }
    forget(account);
}

void FrameScheduler::forget(Accounts::iterator account) {
    if (account->second.viewer_count == 0 && account->second.virtual_time <= virtual_now_) {
        accounts_.erase(account);
    }
}

void FrameScheduler::setReady(uint64_t viewer, Ready ready, Seconds piece, TimePoint now) {
    Entry* entry = find(viewer);
    if (entry == nullptr) {
        return;
    }
    if (entry->ready == Ready::kNo) {
        entry->ready_since = now;
    }
    entry->ready = ready;
    entry->piece = piece;
}

void FrameScheduler::onInput(uint64_t viewer, TimePoint now) {
    Entry* entry = find(viewer);
    if (entry == nullptr) {
        return;
    }
    const Seconds earned = Seconds(now - entry->counted) * (min_interval_ / kMovePeriod);
    entry->movable = std::min(min_interval_, entry->movable + earned);
    entry->counted = now;
    const Seconds early = Seconds(entry->due - now) - kInputLead;
    const Seconds move = std::min({early, min_interval_ / 8, entry->movable});
    if (move > Seconds(0)) {
        entry->movable -= move;
        entry->due -= ticks(move);
    }
}

void FrameScheduler::becomeReady(Entry& entry) const {
    Share& share = entry.account->second;
    entry.virtual_time = std::max(entry.virtual_time, share.virtual_now);
    if (!share.ready) {
        share.virtual_time = std::max(share.virtual_time, virtual_now_);
    }
    if (!entry.served_at) {
        return;
    }
    if (entry.begun_then == begun_count_) {
        const TimePoint ready_at = std::max(entry.readyAt(), entry.ready_since);
        entry.gap = std::max(Seconds(ready_at - *entry.served_at), Seconds(0));
    } else {
        entry.gap *= kGapDecay; // a piece of another's hid when it was
    }
}

void FrameScheduler::refresh(TimePoint now) {
    for (auto& [viewer, entry] : viewers_) {
        entry.held_until.reset();
        const bool is_ready = entry.isReady(now);
        if (is_ready && !entry.was_ready) {
            becomeReady(entry);
        }
        entry.was_ready = is_ready;
    }
    for (auto& [account, share] : accounts_) {
        share.ready = false;
    }
    for (const auto& [viewer, entry] : viewers_) {
        if (entry.was_ready) {
            Share& share = entry.account->second;
            share.due = share.ready ? std::min(share.due, entry.due) : entry.due;
            share.ready = true;
        }
    }
}

// Among equals the one that waits longest.
bool FrameScheduler::isBefore(const Entry& one, const Entry& other) const {
    if (one.account != other.account) {
        const auto key = [this](const Entry& entry) {
            const auto& [account, share] = *entry.account;
            const Seconds now = share.ready ? Seconds(0) : virtual_now_;
            return std::tuple(std::max(share.virtual_time, now), share.due,
                              std::string_view(account.key));
        };
        return key(one) < key(other);
    }
    const auto key = [](const Entry& entry) {
        const Seconds now = entry.was_ready ? Seconds(0) : entry.account->second.virtual_now;
        return std::pair(std::max(entry.virtual_time, now), entry.due);
    };
    return key(one) < key(other);
}

FrameScheduler::Entry* FrameScheduler::heldFor(const Entry& entry, TimePoint now) {
    const Seconds patience = entry.piece * kWorthWaiting;
    for (auto& [viewer, other] : viewers_) {
        if (other.was_ready || !other.served_at || !isBefore(other, entry)) {
            continue;
        }
        const bool paced = other.ready == Ready::kFrame; // until it is due
        const Seconds gap = paced ? Seconds(other.due - *other.served_at) : other.gap;
        if (gap > patience) {
            continue;
        }
        if (now - *other.served_at >= patience) {
            other.gap = patience * kWaitedInVain;
            continue;
        }
        idle_for_ = idle_for_.value_or(viewer);
        return &other;
    }
    return nullptr;
}

std::optional<uint64_t> FrameScheduler::next(TimePoint now) {
    refresh(now);
    idle_for_.reset();
    std::vector<std::pair<uint64_t, Entry*>> ready;
    for (auto& [viewer, entry] : viewers_) {
        if (entry.was_ready) {
            ready.emplace_back(viewer, &entry);
        }
    }
    // A heap, since the first one is rarely held.
    const auto is_behind = [this](const auto& one, const auto& other) {
        return isBefore(*other.second, *one.second);
    };
    std::ranges::make_heap(ready, is_behind);
    for (; !ready.empty(); ready.pop_back()) {
        std::ranges::pop_heap(ready, is_behind);
        const auto& [viewer, entry] = ready.back();
        const Entry* other = heldFor(*entry, now);
        if (other == nullptr) {
            idle_for_.reset();
            return viewer;
        }
        entry->held_until = *other->served_at + ticks(entry->piece * kWorthWaiting);
    }
    return {};
}

std::optional<TimePoint> FrameScheduler::nextDue() const {
    std::optional<TimePoint> earliest;
    for (const auto& [viewer, entry] : viewers_) {
        const TimePoint at = entry.held_until.value_or(entry.readyAt());
        if (entry.ready != Ready::kNo && (!earliest || at < *earliest)) {
            earliest = at;
        }
    }
    return earliest;
}

void FrameScheduler::onStarted(uint64_t viewer) {
    Entry* entry = find(viewer);
    if (entry == nullptr) {
        return;
    }
    ++begun_count_;
    Share& share = entry->account->second;
    share.virtual_now = std::max(share.virtual_now, entry->virtual_time);
    virtual_now_ = std::max(virtual_now_, share.virtual_time);
    for (auto account = accounts_.begin(); account != accounts_.end();) {
        forget(account++);
    }
}

void FrameScheduler::onFrame(uint64_t viewer, TimePoint now) {
    if (Entry* entry = find(viewer); entry != nullptr && !entry->beside) {
        const auto interval = ticks(min_interval_);
        const bool kept_up = now - entry->due < interval;
        entry->due = (kept_up ? entry->due : now) + interval;
    }
}

// Each account gets as much virtual time as every other: n others at 1 leave kBesideShare to one
// that pays (1 / kBesideShare - 1) / n.
double FrameScheduler::priceOf(const Entry& entry) const {
    if (!entry.beside) {
        return 1;
    }
    const auto others = std::ranges::count_if(
        accounts_, [&](const auto& other) { return other.second.viewer_count > 0; });
    return (1 / kBesideShare - 1) / static_cast<double>(std::max<ptrdiff_t>(others - 1, 1));
}

void FrameScheduler::charge(uint64_t viewer, Seconds cost) {
    if (Entry* entry = find(viewer)) {
        const Seconds charged = cost * priceOf(*entry);
        entry->virtual_time += charged;
        entry->account->second.virtual_time += charged;
    }
}

void FrameScheduler::onFinished(uint64_t viewer, Seconds difference, TimePoint now) {
    charge(viewer, difference);
    if (Entry* entry = find(viewer)) {
        entry->served_at = now;
        entry->begun_then = begun_count_;
    }
}

void FrameScheduler::onIdle(Seconds time) {
    if (idle_for_) {
        charge(*idle_for_, time);
        return;
    }
    virtual_now_ += time;
    for (auto account = accounts_.begin(); account != accounts_.end();) {
        account->second.virtual_now += time;
        forget(account++);
    }
}

} // namespace froxel::stream
