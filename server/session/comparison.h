// Two settings of one view, side by side. Pure; any thread.
#pragma once

#include "session/rejection.h"
#include "session/settings.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace froxel::session {

enum class CompareShow : uint8_t { kSides, kHeatMap };
inline constexpr std::array kCompareShowNames = {std::string_view("sides"),
                                                 std::string_view("heat_map")};

// What a view that compares draws besides its own settings, which are the left side's.
struct Comparison {
    SettingChanges right; // never empty
    CompareShow show = CompareShow::kSides;
    // One picture, divided at SessionState::compare_split; false: one above the other, for clients
    // that move the divider themselves.
    bool divided = false;
    bool operator==(const Comparison&) const = default;
};

// Whether the sides may have it otherwise: not what is of the lights, the time, the stream or the
// view's data.
[[nodiscard]] bool canDiffer(const settings::Setting& setting);

// "renderer:naive,list_cap:16": names and values of the page's address. Refused, naming the
// setting: kUnsupported for a name that there is not, kOutOfRange for one that both sides share and
// for a value that it cannot have, or that it is given twice. Empty: no changes.
[[nodiscard]] CommandResult<SettingChanges> parseRight(std::string_view text);
[[nodiscard]] std::string textOf(const SettingChanges& right);

// The right side of a view that compares.
[[nodiscard]] SessionState rightOf(const SessionState& state);

// Whether both sides are the same picture, bit for bit, by docs/figures/error.md.
[[nodiscard]] bool promisesEqualBits(const SessionState& state);

} // namespace froxel::session
