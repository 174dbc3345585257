// An Allowance for each of many who ask. Not thread-safe.
#pragma once

#include "core/allowance.h"

#include <cstddef>
#include <map>

namespace froxel {

template <class Who>
class Allowances {
  public:
    // Of whom it is remembered; who has all of it is forgotten. Beyond that all share one, lest a
    // crowd of names fill memory.
    static constexpr size_t kMost = 4096;

    Allowances(double at_once, double per_second)
        : at_once_(at_once), per_second_(per_second), others_(at_once, per_second) {}

    // Good until the next call.
    [[nodiscard]] Allowance& of(const Who& who, TimePoint now) {
        const auto known = known_.find(who);
        if (known != known_.end()) {
            return known->second;
        }
        if (known_.size() >= kMost) {
            std::erase_if(known_,
                          [&](const auto& entry) { return entry.second.leftAt(now) >= at_once_; });
        }
        return known_.size() >= kMost
                   ? others_
                   : known_.try_emplace(who, at_once_, per_second_).first->second;
    }

  private:
    const double at_once_;
    const double per_second_;
    std::map<Who, Allowance> known_;
    Allowance others_;
};

} // namespace froxel
