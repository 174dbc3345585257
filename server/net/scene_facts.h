// What a scene is, as JSON for programs: see "Facts" in docs/guide/stills.md. Pure; any thread.
#pragma once

#include "session/session_context.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::net {

[[nodiscard]] nlohmann::ordered_json factsOf(const session::SceneSummary& scene);

} // namespace froxel::net
