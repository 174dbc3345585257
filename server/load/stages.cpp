#include "load/stages.h"

#include "core/text.h"
#include "load/list_text.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

namespace froxel::load {
namespace {

constexpr uint32_t kMostViewers = 10'000;
constexpr double kMostSeconds = 86'400;
constexpr size_t kMostStages = 100;
constexpr size_t kMostVisits = 100'000;

constexpr std::array kUnits = {
    std::pair{std::string_view("ms"), 0.001}, std::pair{std::string_view("s"), 1.0},
    std::pair{std::string_view("m"), 60.0}, std::pair{std::string_view("h"), 3600.0}};

Error badStage(std::string_view stage, const std::string& reason) {
    return {ErrorCode::kInvalidArgument, "stage '" + printable(stage) + "' " + reason +
                                             "; expected LENGTH:VIEWERS, such as 1m:10"};
}

std::optional<Seconds> lengthFrom(std::string_view text) {
    double unit = 1;
    const size_t digits = text.find_last_of("0123456789.") + 1; // npos + 1 is 0
    if (digits < text.size()) {
        const auto* const known = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& one) {
            return one.first == text.substr(digits);
        });
        if (known == kUnits.end()) {
            return std::nullopt;
        }
        unit = known->second;
    }
    const auto number = numberFrom<double>(text.substr(0, digits));
    const bool valid = number && *number >= 0 && *number * unit <= kMostSeconds;
    return valid ? std::optional(Seconds(*number * unit)) : std::nullopt;
}

Result<Stage> stageFrom(std::string_view text) {
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) {
        return badStage(text, "has no ':'");
    }
    const auto length = lengthFrom(text.substr(0, colon));
    if (!length) {
        return badStage(text, "has no length of 0 to 86400 s");
    }
    const auto viewers = numberFrom<uint32_t>(text.substr(colon + 1));
    if (!viewers || *viewers > kMostViewers) {
        return badStage(text, "has no number of viewers from 0 to " + numberText(kMostViewers));
    }
    return Stage{*length, *viewers};
}

} // namespace

Result<std::vector<Stage>> parseStages(std::string_view text) {
    std::vector<Stage> stages;
    for (const std::string_view part : partsOf(text)) {
        const auto stage = stageFrom(part);
        if (!stage) {
            return stage.error();
        }
        stages.push_back(*stage);
    }
    const auto refuse = [](const std::string& reason) {
        return Error{ErrorCode::kInvalidArgument, reason};
    };
    if (stages.size() > kMostStages) {
        return refuse(numberText(stages.size()) + " stages; expected " + numberText(kMostStages) +
                      " or fewer");
    }
    if (lengthOf(stages) <= Seconds(0) || lengthOf(stages) > Seconds(kMostSeconds)) {
        return refuse("the stages take " + numberText(lengthOf(stages).count()) +
                      " s together; expected more than 0 and no more than 86400 s");
    }
    const size_t visits = visitsOf(stages).size();
    if (visits == 0 || visits > kMostVisits) {
        return refuse("the stages let " + numberText(visits) + " viewers join; expected 1 to " +
                      numberText(kMostVisits));
    }
    return stages;
}

Seconds lengthOf(const std::vector<Stage>& stages) {
    return std::accumulate(stages.begin(), stages.end(), Seconds(0),
                           [](Seconds sum, const Stage& stage) { return sum + stage.length; });
}

uint32_t mostViewersOf(const std::vector<Stage>& stages) {
    uint32_t most = 0;
    for (const Stage& stage : stages) {
        most = std::max(most, stage.viewers);
    }
    return most;
}

std::vector<Visit> visitsOf(const std::vector<Stage>& stages) {
    std::vector<Visit> visits;
    std::vector<size_t> present; // those that are there, oldest first
    Seconds begin{0};
    for (const Stage& stage : stages) {
        const size_t before = present.size();
        const size_t change =
            stage.viewers > before ? stage.viewers - before : before - stage.viewers;
        for (size_t step = 0; step < change; ++step) {
            const double share = 1.0 / static_cast<double>(change);
            if (stage.viewers > before) { // the first one at once
                present.push_back(visits.size());
                visits.push_back({begin + stage.length * (static_cast<double>(step) * share), {}});
            } else { // the last one at the stage's end
                visits[present.back()].leave =
                    begin + stage.length * (static_cast<double>(step + 1) * share);
                present.pop_back();
            }
        }
        begin += stage.length;
    }
    return visits;
}

std::vector<Visit> visitsOver(Seconds ramp, uint32_t count) {
    return visitsOf({{ramp, count}});
}

std::vector<size_t> dealOut(const std::vector<uint32_t>& shares, size_t count) {
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    std::vector<double> due(shares.size(), 0); // what each should have had more than it has
    std::vector<size_t> dealt;
    dealt.reserve(count);
    while (dealt.size() < count) {
        for (size_t share = 0; share < shares.size(); ++share) {
            due[share] += shares[share] / all;
        }
        const auto next = std::max_element(due.begin(), due.end());
        *next -= 1;
        dealt.push_back(static_cast<size_t>(next - due.begin()));
    }
    return dealt;
}

} // namespace froxel::load
