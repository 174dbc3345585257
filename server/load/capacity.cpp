#include "load/capacity.h"

#include <algorithm>

namespace froxel::load {
namespace {

bool allHeld(const Trials& trials) {
    return trials.held == trials.all;
}

bool allBroke(const Trials& trials) {
    return trials.held == 0;
}

} // namespace

void CapacitySearch::note(uint32_t viewers, bool held) {
    Trials& trials = by_viewers_[viewers];
    ++trials.all;
    trials.held += held ? 1 : 0;
}

uint32_t CapacitySearch::held() const {
    for (auto at = by_viewers_.rbegin(); at != by_viewers_.rend(); ++at) {
        if (allHeld(at->second)) {
            return at->first;
        }
    }
    return 0;
}

std::optional<uint32_t> CapacitySearch::broken() const {
    const uint32_t below = held();
    for (const auto& [viewers, trials] : by_viewers_) {
        if (viewers > below && allBroke(trials)) {
            return viewers;
        }
    }
    return std::nullopt;
}

bool CapacitySearch::needsMore(uint32_t viewers) const {
    const auto known = by_viewers_.find(viewers);
    return known == by_viewers_.end() || known->second.all < trials_;
}

std::optional<uint32_t> CapacitySearch::next() const {
    const uint32_t low = held();
    const auto high = broken();
    if (!high) {
        if (low < most_) {
            // A number above `low` whose trials differ says neither; beyond it lies what breaks.
            const uint32_t known = by_viewers_.empty() ? 0 : by_viewers_.rbegin()->first;
            const uint32_t base = std::max(low, known);
            if (base < most_) {
                return base == low ? std::min(most_, std::max(1U, 2 * low)) : base + 1;
            }
        }
        return low > 0 && needsMore(low) ? std::optional(low) : std::nullopt;
    }
    // Untried numbers between: halve, unless only those whose trials differ are left there.
    for (uint32_t middle = low + (*high - low) / 2; middle > low; --middle) {
        if (!by_viewers_.contains(middle)) {
            return middle;
        }
    }
    for (uint32_t middle = low + (*high - low) / 2 + 1; middle < *high; ++middle) {
        if (!by_viewers_.contains(middle)) {
            return middle;
        }
    }
    if (low > 0 && needsMore(low)) {
        return low;
    }
    if (needsMore(*high)) {
        return *high;
    }
    return std::nullopt;
}

} // namespace froxel::load
