// Several results of `froxel bench` as one, where a machine lends its time in parts. Pure.
#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <span>

namespace froxel::bench {

// The sweeps of all, in order. Errors: kInvalidArgument where one is not a result of this schema,
// where two have the same sweep, or where device, build, scene, method or views differ; the text
// names what. `complete` where all are, `elapsed_s` their sum, the rest as in the first.
[[nodiscard]] Result<nlohmann::ordered_json>
joinReports(std::span<const nlohmann::ordered_json> reports);

} // namespace froxel::bench
