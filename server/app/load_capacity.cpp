#include "app/load_capacity.h"

#include "app/load_report.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace froxel::app {
namespace {

using Json = nlohmann::ordered_json;

std::string plural(uint32_t viewers) {
    return fmt::format("{} {}", viewers, viewers == 1 ? "viewer" : "viewers");
}

// "held in 3 of 3 trials with 16 viewers".
std::string trialsText(uint32_t viewers, const load::Trials& trials) {
    return fmt::format("held in {} of {} trials with {}", trials.held, trials.all, plural(viewers));
}

} // namespace

LoadTrial trialOf(uint32_t viewers, const load::RunResult& result, const LoadVerdict& verdict) {
    return {viewers, verdict.held(), brokenLine(verdict), verdict.outcomes, servedKinds(result)};
}

std::string trialLine(const LoadTrial& trial) {
    std::vector<std::string> words;
    for (const load::Outcome& outcome : trial.outcomes) {
        words.push_back(load::wordsOf(outcome));
    }
    return fmt::format("{:>5} viewers  {}  {}\n", trial.viewers, trial.held ? "held  " : "broken",
                       trial.held ? fmt::format("{}", fmt::join(words, ", "))
                                  : trial.broken.value_or(""));
}

std::string capacityText(const load::CapacitySearch& search,
                         const std::vector<LoadTrial>& trials,
                         bool stopped) {
    if (stopped || trials.empty()) {
        return fmt::format("stopped after {} trials; {} held so far\n", trials.size(),
                           plural(search.held()));
    }
    const uint32_t held = search.held();
    const auto broken = search.broken();
    std::vector<std::string> parts;
    for (const auto& [viewers, of] : search.trials()) {
        if (viewers == held || (viewers > held && (!broken || viewers <= *broken))) {
            parts.push_back(trialsText(viewers, of));
        }
    }
    return fmt::format("capacity: {}{} ({})\n", broken ? "" : "at least ", plural(held),
                       fmt::join(parts, ", "));
}

Json capacityReport(const LoadOptions& options,
                    const load::RunOptions& run,
                    const load::CapacitySearch& search,
                    const std::vector<LoadTrial>& trials,
                    bool stopped) {
    Json rows = Json::array();
    for (const LoadTrial& trial : trials) {
        rows.push_back({{"viewers", trial.viewers},
                        {"held", trial.held},
                        {"broken", trial.broken ? Json(*trial.broken) : Json(nullptr)},
                        {"requirements", outcomesOf(trial.outcomes)}});
    }
    Json required = Json::array();
    if (!trials.empty()) {
        for (const load::Outcome& outcome : trials.front().outcomes) {
            required.push_back(outcome.requirement);
        }
    }
    const auto broken = search.broken();
    Json report = {{"schema", "froxel.capacity.v1"}};
    report.update(loadSetup(options, run));
    report.update({{"served", trials.empty() ? Json::array() : trials.front().served},
                   {"required", std::move(required)},
                   {"capacity", search.held()},
                   {"broken_from", broken ? Json(*broken) : Json(nullptr)},
                   {"trials_each", options.trial_count},
                   {"stopped", stopped},
                   {"trials", std::move(rows)}});
    return report;
}

} // namespace froxel::app
