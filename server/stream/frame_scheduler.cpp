#include "stream/frame_scheduler.h"

#include <algorithm>

namespace froxel::stream {

namespace {

// Commands wait this long for their frame, so that one that comes a little late is still in it.
constexpr Seconds kInputLead{0.0015};
// In which the grid moves by an interval at most.
constexpr Seconds kMovePeriod{1.0};

} // namespace

void FrameScheduler::add(uint64_t viewer) {
    viewers_[viewer].virtual_time = virtual_now_;
}

void FrameScheduler::remove(uint64_t viewer) {
    viewers_.erase(viewer);
}

void FrameScheduler::setReady(uint64_t viewer, Ready ready) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) {
        return;
    }
    Entry& entry = found->second;
    if (ready != Ready::kNo && entry.ready == Ready::kNo) {
        entry.virtual_time = std::max(entry.virtual_time, virtual_now_);
    }
    entry.ready = ready;
}

void FrameScheduler::onInput(uint64_t viewer, TimePoint now) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) {
        return;
    }
    Entry& entry = found->second;
    const Seconds earned = Seconds(now - entry.counted) * (min_interval_ / kMovePeriod);
    entry.movable = std::min(min_interval_, entry.movable + earned);
    entry.counted = now;
    const Seconds early = Seconds(entry.due - now) - kInputLead;
    const Seconds move = std::min({early, min_interval_ / 8, entry.movable});
    if (move > Seconds(0)) {
        entry.movable -= move;
        entry.due -= std::chrono::duration_cast<Clock::duration>(move);
    }
}

std::optional<uint64_t> FrameScheduler::next(TimePoint now) const {
    std::optional<uint64_t> chosen;
    const Entry* best = nullptr;
    for (const auto& [viewer, entry] : viewers_) {
        if (entry.ready == Ready::kNo || entry.readyAt() > now) {
            continue;
        }
        // Among equals the one that waits longest.
        if (best == nullptr || entry.virtual_time < best->virtual_time ||
            (entry.virtual_time == best->virtual_time && entry.due < best->due)) {
            chosen = viewer;
            best = &entry;
        }
    }
    return chosen;
}

std::optional<TimePoint> FrameScheduler::nextDue() const {
    std::optional<TimePoint> earliest;
    for (const auto& [viewer, entry] : viewers_) {
        if (entry.ready != Ready::kNo && (!earliest || entry.readyAt() < *earliest)) {
            earliest = entry.readyAt();
        }
    }
    return earliest;
}

void FrameScheduler::onStarted(uint64_t viewer) {
    const auto found = viewers_.find(viewer);
    if (found != viewers_.end()) {
        virtual_now_ = std::max(virtual_now_, found->second.virtual_time);
    }
}

void FrameScheduler::onFrame(uint64_t viewer, TimePoint now) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) {
        return;
    }
    Entry& entry = found->second;
    const auto interval = std::chrono::duration_cast<Clock::duration>(min_interval_);
    const bool kept_up = now - entry.due < interval;
    entry.due = (kept_up ? entry.due : now) + interval;
}

void FrameScheduler::charge(uint64_t viewer, Seconds cost) {
    const auto found = viewers_.find(viewer);
    if (found != viewers_.end()) {
        found->second.virtual_time += cost;
    }
}

} // namespace froxel::stream
