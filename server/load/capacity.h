// How many viewers a server carries, from trials that hold what is required or break it. Pure; the
// caller runs the trials.
//
// The number of viewers is doubled until a trial breaks, then halved in between. The two numbers
// beside the limit are tried again until each has had all its trials; a number whose trials differ
// moves the search one step down or up. It supposes that more viewers never make it easier.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace froxel::load {

struct Trials {
    uint32_t held = 0;
    uint32_t all = 0;
};

class CapacitySearch {
  public:
    // `most` viewers are tried at the most, each number beside the limit `trials` times; both
    // from 1.
    CapacitySearch(uint32_t most, uint32_t trials) : most_(most), trials_(trials) {}

    // With how many viewers to try next; none: the search is over.
    [[nodiscard]] std::optional<uint32_t> next() const;
    // Of a trial.
    void note(uint32_t viewers, bool held);

    // The greatest number whose every trial held; 0: none did.
    [[nodiscard]] uint32_t held() const;
    // The least number above held() whose every trial broke; none: no trial with `most` broke.
    [[nodiscard]] std::optional<uint32_t> broken() const;
    [[nodiscard]] const std::map<uint32_t, Trials>& trials() const { return by_viewers_; }

  private:
    [[nodiscard]] bool needsMore(uint32_t viewers) const;

    const uint32_t most_;
    const uint32_t trials_;
    std::map<uint32_t, Trials> by_viewers_;
};

} // namespace froxel::load
