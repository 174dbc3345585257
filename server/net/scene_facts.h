// What a scene is and what of it a view shows, as JSON for programs: see "Facts" in
// docs/guide/stills.md. Pure; any thread.
#pragma once

#include "session/session_context.h"
#include "still/picture_facts.h"

#include <nlohmann/json_fwd.hpp>

namespace froxel::net {

[[nodiscard]] nlohmann::ordered_json factsOf(const session::SceneSummary& scene);

// What a view of the scene shows, by a picture of the debug view "instances": members of its facts.
[[nodiscard]] nlohmann::ordered_json coverageOf(const session::SceneSummary& scene,
                                                const still::CoveredPixels& pixels);

} // namespace froxel::net
