// What `froxel load --find` tells: pure functions of its trials. The JSON:
//
//   schema       "froxel.capacity.v1"
//   froxel to host   as in load_report.h; seconds are those of a trial
//   served       as there, of the first trial
//   required     [...]: the requirements
//   capacity     with how many viewers every trial held; 0: with none
//   broken_from  the next number of which every trial broke; null: the most that --viewers allows
//   held trials_each  --trials stopped      whether a signal ended the search; what is above is
//   then not the capacity trials       [{viewers, held, broken, requirements}, ...] in their order,
//   broken one line or null
#pragma once

#include "app/load_command.h"
#include "app/load_verdict.h"
#include "load/capacity.h"
#include "load/load_run.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct LoadTrial {
    uint32_t viewers = 0;
    bool held = false;
    std::optional<std::string> broken; // one line
    std::vector<load::Outcome> outcomes;
    nlohmann::ordered_json served;
};

[[nodiscard]] LoadTrial
trialOf(uint32_t viewers, const load::RunResult& result, const LoadVerdict& verdict);

// "12 viewers: held   latency.p95<50: 21.3, fps>=30: 59.8".
[[nodiscard]] std::string trialLine(const LoadTrial& trial);

// For a person: the capacity, and how sure that is.
[[nodiscard]] std::string capacityText(const load::CapacitySearch& search,
                                       const std::vector<LoadTrial>& trials,
                                       bool stopped);

[[nodiscard]] nlohmann::ordered_json capacityReport(const LoadOptions& options,
                                                    const load::RunOptions& run,
                                                    const load::CapacitySearch& search,
                                                    const std::vector<LoadTrial>& trials,
                                                    bool stopped);

} // namespace froxel::app
