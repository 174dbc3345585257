#include "app/load_verdict.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace froxel::app {
namespace {

using load::RunResult;
using load::ViewerResult;

std::optional<std::string> failureOf(const RunResult& result, bool may_be_refused, bool may_fail) {
    const auto failed = [&](const ViewerResult& viewer) {
        return viewer.failure && !(viewer.refused ? may_be_refused : may_fail);
    };
    const auto first = std::find_if(result.viewers.begin(), result.viewers.end(), failed);
    if (first == result.viewers.end()) {
        return std::nullopt;
    }
    return fmt::format("{} of {} viewers failed: viewer {}: {}",
                       std::count_if(result.viewers.begin(), result.viewers.end(), failed),
                       result.viewers.size(), std::distance(result.viewers.begin(), first) + 1,
                       *first->failure);
}

} // namespace

bool LoadVerdict::held() const {
    return !failure && std::all_of(outcomes.begin(), outcomes.end(),
                                   [](const load::Outcome& outcome) { return outcome.held; });
}

LoadVerdict loadVerdict(const std::vector<load::Requirement>& requirements,
                        const RunResult& result) {
    return {failureOf(result, load::namesFigure(requirements, "refused"),
                      load::namesFigure(requirements, "failed")),
            load::check(requirements, result)};
}

std::optional<std::string> brokenLine(const LoadVerdict& verdict) {
    std::vector<std::string> faults;
    if (verdict.failure) {
        faults.push_back(*verdict.failure);
    }
    for (const load::Outcome& outcome : verdict.outcomes) {
        if (!outcome.held) {
            faults.push_back("broken requirement " + load::wordsOf(outcome));
        }
    }
    return faults.empty() ? std::nullopt
                          : std::optional(fmt::format("{}", fmt::join(faults, "; ")));
}

std::vector<JunitCase> casesOf(const LoadVerdict& verdict) {
    std::vector<JunitCase> cases = {{"no viewer fails", verdict.failure.value_or("")}};
    for (const load::Outcome& outcome : verdict.outcomes) {
        cases.push_back({outcome.requirement, outcome.held ? "" : load::wordsOf(outcome)});
    }
    return cases;
}

} // namespace froxel::app
