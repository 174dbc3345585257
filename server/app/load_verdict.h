// Whether what the viewers of `froxel load` measured is as required. Pure functions.
#pragma once

#include "app/junit.h"
#include "load/load_run.h"
#include "load/requirement.h"

#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct LoadVerdict {
    std::optional<std::string> failure; // one line; none: no viewer failed, or only as it may
    std::vector<load::Outcome> outcomes;
    // Also of `failure`.
    [[nodiscard]] bool held() const;
};

// A viewer that failed or was refused is a failure, unless a requirement bounds the share of those.
[[nodiscard]] LoadVerdict loadVerdict(const std::vector<load::Requirement>& requirements,
                                      const load::RunResult& result);

// One line of all that is wrong; none: nothing is.
[[nodiscard]] std::optional<std::string> brokenLine(const LoadVerdict& verdict);

// A test case for each requirement, and one that no viewer failed.
[[nodiscard]] std::vector<JunitCase> casesOf(const LoadVerdict& verdict);

} // namespace froxel::app
