// What a viewer asks for between Welcome and its script, by its options.
#pragma once

#include "load/viewer.h"

#include <vector>

namespace froxel::load {

// In their order, without seq and time. `state` becomes what the server will answer; scripts start
// from it. Pure.
[[nodiscard]] std::vector<v1::ClientMessage> openingOf(const ViewerOptions& options,
                                                       v1::ViewState& state);

} // namespace froxel::load
