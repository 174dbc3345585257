// How often one kind of event may be logged. Pure: time is passed in. Kinds come from our own code,
// so their number is bounded.
#pragma once

#include "core/clock.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::app {

class LogLimit {
  public:
    // At most `burst` lines of a kind within `period` from its first.
    LogLimit(uint32_t burst, Seconds period) : burst_(burst), period_(period) {}

    // Whether a line of this kind may be written now.
    [[nodiscard]] bool admit(std::string_view kind, TimePoint now);

    struct LeftOut {
        std::string kind;
        uint64_t count = 0;
    };
    // What was left out in periods that are over, each told once; with `end` in all periods.
    [[nodiscard]] std::vector<LeftOut> takeLeftOut(TimePoint now, bool end = false);

  private:
    struct Kind {
        TimePoint since{};
        uint32_t said = 0; // since then
        uint64_t left_out = 0;
    };
    const uint32_t burst_;
    const Seconds period_;
    std::map<std::string, Kind, std::less<>> kinds_;
};

} // namespace froxel::app
