// A session's settings as the protocol tells them. Pure; any thread.
#pragma once

#include "froxel/v1/common.pb.h"
#include "session/session_state.h"

namespace froxel::session {

void fillBox(v1::Box& out, const BoundsD3& bounds);
// Every field, for a fresh message. Placed lights are told apart.
void fillViewState(v1::ViewState& out, const SessionContext& context, const SessionState& state);

} // namespace froxel::session
