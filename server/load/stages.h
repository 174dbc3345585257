// How many viewers there are over time, and which script each plays. Pure.
#pragma once

#include "core/clock.h"
#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace froxel::load {

// As k6 has it: during a stage the number of viewers goes linearly from the stage before, at first
// 0, to this one's.
struct Stage {
    Seconds length{0};
    uint32_t viewers = 0;
    bool operator==(const Stage&) const = default;
};

// From when to when one viewer is there, since the run's start.
struct Visit {
    Seconds join{0};
    std::optional<Seconds> leave; // none: it stays until the run ends
    bool operator==(const Visit&) const = default;
};

// "1m:10,2m:10,30s:0"; a length is a number of seconds, or one with ms, s, m or h behind it.
// Errors: kInvalidArgument, naming the stage.
[[nodiscard]] Result<std::vector<Stage>> parseStages(std::string_view text);

[[nodiscard]] Seconds lengthOf(const std::vector<Stage>& stages);
// At the same time.
[[nodiscard]] uint32_t mostViewersOf(const std::vector<Stage>& stages);

// In the order in which viewers join. While the number falls, the newest viewer leaves first.
[[nodiscard]] std::vector<Visit> visitsOf(const std::vector<Stage>& stages);

// `count` viewers that join over `ramp` and stay.
[[nodiscard]] std::vector<Visit> visitsOver(Seconds ramp, uint32_t count);

// Which of the shares each of `count` viewers has, by index: of any first viewers each share has
// its part to within one. At least one share; all are above 0.
[[nodiscard]] std::vector<size_t> dealOut(const std::vector<uint32_t>& shares, size_t count);

} // namespace froxel::load
