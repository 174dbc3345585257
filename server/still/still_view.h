// The view of a still, by the names and texts of the page's address
// (client-web/src/state/address.ts). Pure; any thread.
#pragma once

#include "session/rejection.h"
#include "session/scene_port.h"
#include "session/session_state.h"

#include <string>
#include <string_view>
#include <vector>

namespace froxel::still {

// Untrusted.
struct Entry {
    std::string name;
    std::string text;
    bool operator==(const Entry&) const = default;
};
using Entries = std::vector<Entry>;

// Whether entries may have this name; "look" is one.
[[nodiscard]] bool isViewName(std::string_view name);

// What a new session on this scene begins with, and over it what the entries say; `look`, a look's
// name, before the others. Lights stand where they are at light_time, animations at
// animation_time; else both at 0. So the same entries are the same picture at any time.
// Of `size` "auto@..." is passed over: there is no window. Refused: kUnsupported, an unknown name;
// else as session::apply().
[[nodiscard]] session::CommandResult<session::SessionState>
viewOf(const session::SharedContext& scene, const Entries& entries, TimePoint now);

// A picture of the same shape whose area is so many times smaller, each side a whole number.
[[nodiscard]] settings::Size smaller(const settings::Size& size, double times);

} // namespace froxel::still
