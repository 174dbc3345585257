// A session goes over to another scene. Pure.
#pragma once

#include "session/scene_port.h"
#include "session/session_state.h"

namespace froxel::session {

// What a new session on it begins with; the state refers to it.
[[nodiscard]] SessionState beginOn(const SharedContext& scene, TimePoint now);

// The state after `before` on another scene: its camera, bounds, animation, variant, exposure and
// lights are the scene's own, placed lights are gone, and what the viewer has set besides, other
// than `first` has it, stays. `first` is what a session on the scene before begins with. The stamp
// is that of the command behind it.
[[nodiscard]] SessionState withScene(const SessionState& before,
                                     const SessionState& first,
                                     const SharedContext& scene,
                                     const CommandStamp& stamp,
                                     TimePoint now);

} // namespace froxel::session
