#include "load/requirement.h"

#include "core/text.h"
#include "load/list_text.h"
#include "report/statistics.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace froxel::load {
namespace {

constexpr double kStallShare = 0.05; // of the measured time that may lie beyond a stall

// Of one viewer; none: it has none.
using ViewerValue = std::optional<double> (*)(const ViewerResult&);
using RunValue = double (*)(const RunResult&);

struct ViewerFigure {
    std::string_view name;
    ViewerValue value;
};
struct RunFigure {
    std::string_view name;
    RunValue value;
};

template <class Value>
std::optional<double> whereMeasured(const ViewerResult& viewer, Value value) {
    return viewer.measured.seconds > 0 ? std::optional(static_cast<double>(value)) : std::nullopt;
}

std::optional<double> jitterMs(const ViewerResult& viewer) {
    const auto& intervals_ms = viewer.measured.samples.interval_ms;
    if (intervals_ms.empty()) {
        return std::nullopt;
    }
    const auto summary = report::summarize(intervals_ms);
    return summary.p99 - summary.median;
}

constexpr std::array kViewerFigures = {
    ViewerFigure{"fps",
                 [](const ViewerResult& viewer) {
                     return whereMeasured(viewer, viewer.measured.framesPerSecond());
                 }},
    ViewerFigure{"mbps",
                 [](const ViewerResult& viewer) {
                     const auto bits = static_cast<double>(viewer.received_bytes) * 8;
                     return whereMeasured(viewer, bits / 1e6 / viewer.measured.seconds);
                 }},
    ViewerFigure{
        "stall",
        [](const ViewerResult& viewer) { return whereMeasured(viewer, stallMs(viewer.measured)); }},
    ViewerFigure{"first_frame",
                 [](const ViewerResult& viewer) {
                     return viewer.first_frame_ms ? viewer.first_frame_ms
                                                  : viewer.first_frame_wait_ms;
                 }},
    ViewerFigure{"jitter", jitterMs},
    ViewerFigure{"dropped", [](const ViewerResult& viewer) {
                     return whereMeasured(viewer, viewer.measured.server_dropped +
                                                      viewer.measured.client_dropped);
                 }}};

double shareOf(const RunResult& result, bool refused) {
    double tried = 0;
    double failed = 0;
    for (const ViewerResult& viewer : result.viewers) {
        tried += viewer.tried ? 1 : 0;
        failed += viewer.failure && viewer.refused == refused ? 1 : 0;
    }
    return failed / std::max(tried, 1.0);
}

double sumOf(const RunResult& result, uint64_t Counts::*count) {
    return std::accumulate(result.viewers.begin(), result.viewers.end(), 0.0,
                           [count](double sum, const ViewerResult& viewer) {
                               return sum + static_cast<double>(viewer.measured.*count);
                           });
}

constexpr std::array kRunFigures = {
    RunFigure{"refused", [](const RunResult& result) { return shareOf(result, true); }},
    RunFigure{"failed", [](const RunResult& result) { return shareOf(result, false); }},
    RunFigure{"errors", [](const RunResult& result) { return sumOf(result, &Counts::errors); }},
    RunFigure{"unshown",
              [](const RunResult& result) { return sumOf(result, &Counts::commands_unshown); }}};

// Requirement::figure counts through these three.
constexpr size_t kFirstViewerFigure = kSampleSeries.size();
constexpr size_t kFirstRunFigure = kFirstViewerFigure + kViewerFigures.size();
constexpr size_t kFigureCount = kFirstRunFigure + kRunFigures.size();

std::string_view nameOf(size_t figure) {
    if (figure < kFirstViewerFigure) {
        return kSampleSeries[figure].name;
    }
    return figure < kFirstRunFigure ? kViewerFigures[figure - kFirstViewerFigure].name
                                    : kRunFigures[figure - kFirstRunFigure].name;
}

// How many statistics may follow a figure.
std::pair<size_t, size_t> statisticsOf(size_t figure) {
    if (figure < kFirstViewerFigure) {
        return {1, 2};
    }
    return figure < kFirstRunFigure ? std::pair<size_t, size_t>{0, 1}
                                    : std::pair<size_t, size_t>{0, 0};
}

constexpr std::array kComparisons = {std::pair{std::string_view("<="), Comparison::kAtMost},
                                     std::pair{std::string_view(">="), Comparison::kAtLeast},
                                     std::pair{std::string_view("<"), Comparison::kLess},
                                     std::pair{std::string_view(">"), Comparison::kGreater}};

constexpr std::array kStatistics = {std::pair{std::string_view("min"), Statistic::Kind::kMin},
                                    std::pair{std::string_view("mean"), Statistic::Kind::kMean},
                                    std::pair{std::string_view("median"), Statistic::Kind::kMedian},
                                    std::pair{std::string_view("max"), Statistic::Kind::kMax}};

std::optional<Statistic> statisticFrom(std::string_view text) {
    for (const auto& [name, kind] : kStatistics) {
        if (name == text) {
            return Statistic{kind, 0};
        }
    }
    const auto percent = text.starts_with('p') ? numberFrom<double>(text.substr(1)) : std::nullopt;
    if (!percent || !(*percent > 0 && *percent <= 100)) {
        return std::nullopt;
    }
    return Statistic{Statistic::Kind::kPercentile, *percent};
}

double valueOf(const Statistic& statistic, const std::vector<double>& samples) {
    switch (statistic.kind) {
    case Statistic::Kind::kMin:
        return report::summarize(samples).min;
    case Statistic::Kind::kMean:
        return report::summarize(samples).mean;
    case Statistic::Kind::kMedian:
        return report::summarize(samples).median;
    case Statistic::Kind::kMax:
        return report::summarize(samples).max;
    case Statistic::Kind::kPercentile:
        break;
    }
    return report::percentileOf(samples, statistic.percent);
}

// "p99.9" has a point of its own: what follows a point is a statistic unless digits begin it.
std::vector<std::string_view> splitFigure(std::string_view text) {
    std::vector<std::string_view> parts;
    size_t begin = 0;
    for (size_t at = 0; at <= text.size(); ++at) {
        const bool splits = at == text.size() ||
                            (text[at] == '.' &&
                             (at + 1 == text.size() || text[at + 1] < '0' || text[at + 1] > '9'));
        if (splits) {
            parts.push_back(text.substr(begin, at - begin));
            begin = at + 1;
        }
    }
    return parts;
}

std::string figureNames() {
    std::string names;
    for (size_t figure = 0; figure < kFigureCount; ++figure) {
        names += (names.empty() ? "" : ", ") + std::string(nameOf(figure));
    }
    return names;
}

Error badRequirement(std::string_view requirement, const std::string& reason) {
    return {ErrorCode::kInvalidArgument,
            "requirement '" + printable(requirement, 80) + "': " + reason};
}

Result<void> readFigure(std::string_view text, Requirement& requirement) {
    const auto parts = splitFigure(text);
    while (requirement.figure < kFigureCount && nameOf(requirement.figure) != parts.front()) {
        ++requirement.figure;
    }
    if (requirement.figure == kFigureCount) {
        return badRequirement(requirement.text, "'" + printable(parts.front(), 40) +
                                                    "' is not a figure; expected one of " +
                                                    figureNames());
    }
    for (size_t part = 1; part < parts.size(); ++part) {
        const auto statistic = statisticFrom(parts[part]);
        if (!statistic) {
            return badRequirement(
                requirement.text,
                "'" + printable(parts[part], 40) +
                    "' is not a statistic; expected min, mean, median, max or pN");
        }
        requirement.statistics.push_back(*statistic);
    }
    const auto [least, most] = statisticsOf(requirement.figure);
    if (requirement.statistics.size() < least) {
        return badRequirement(
            requirement.text,
            fmt::format("'{0}' needs a statistic, such as {0}.p95", nameOf(requirement.figure)));
    }
    if (requirement.statistics.size() > most) {
        return badRequirement(requirement.text,
                              fmt::format("'{}' has {} statistics; expected {} or fewer",
                                          nameOf(requirement.figure), requirement.statistics.size(),
                                          most));
    }
    return {};
}

Result<Requirement> requirementFrom(std::string_view given) {
    Requirement requirement;
    std::copy_if(given.begin(), given.end(), std::back_inserter(requirement.text),
                 [](char c) { return c != ' '; });
    const std::string_view text = requirement.text;
    const size_t at = text.find_first_of("<>=");
    const auto* const comparison =
        at == std::string_view::npos
            ? kComparisons.end()
            : std::find_if(kComparisons.begin(), kComparisons.end(),
                           [&](const auto& one) { return text.substr(at).starts_with(one.first); });
    if (comparison == kComparisons.end()) {
        return badRequirement(
            text, "expected FIGURE<NUMBER, with <, <=, > or >=, such as latency.p99<80");
    }
    if (const auto read = readFigure(text.substr(0, at), requirement); !read) {
        return read.error();
    }
    std::string_view number = text.substr(at + comparison->first.size());
    const bool percent = number.ends_with('%');
    number.remove_suffix(percent ? 1 : 0);
    const auto limit = numberFrom<double>(number);
    if (!limit || !(*limit >= 0 && std::isfinite(*limit))) {
        return badRequirement(text, "'" + printable(number, 40) +
                                        "' is not a number from 0; expected such as 80 or 5%");
    }
    requirement.comparison = comparison->second;
    requirement.limit = *limit / (percent ? 100 : 1);
    return requirement;
}

std::optional<double> sampleFigure(const Requirement& requirement, const RunResult& result) {
    const auto samples = kSampleSeries[requirement.figure].samples;
    const bool each = requirement.statistics.size() > 1;
    std::vector<double> values;
    for (const ViewerResult& viewer : result.viewers) {
        const auto& of_viewer = viewer.measured.samples.*samples;
        if (!each) {
            values.insert(values.end(), of_viewer.begin(), of_viewer.end());
        } else if (!of_viewer.empty()) {
            values.push_back(valueOf(requirement.statistics[0], of_viewer));
        }
    }
    return values.empty() ? std::nullopt
                          : std::optional(valueOf(requirement.statistics.back(), values));
}

std::optional<double> viewerFigure(const Requirement& requirement, const RunResult& result) {
    const bool above = requirement.comparison == Comparison::kGreater ||
                       requirement.comparison == Comparison::kAtLeast;
    const Statistic worst{above ? Statistic::Kind::kMin : Statistic::Kind::kMax, 0};
    std::vector<double> values;
    for (const ViewerResult& viewer : result.viewers) {
        if (const auto value =
                kViewerFigures[requirement.figure - kFirstViewerFigure].value(viewer)) {
            values.push_back(*value);
        }
    }
    if (values.empty()) {
        return std::nullopt;
    }
    return valueOf(requirement.statistics.empty() ? worst : requirement.statistics[0], values);
}

std::optional<double> measuredOf(const Requirement& requirement, const RunResult& result) {
    if (requirement.figure < kFirstViewerFigure) {
        return sampleFigure(requirement, result);
    }
    return requirement.figure < kFirstRunFigure
               ? viewerFigure(requirement, result)
               : kRunFigures[requirement.figure - kFirstRunFigure].value(result);
}

bool holds(const Requirement& requirement, double measured) {
    switch (requirement.comparison) {
    case Comparison::kLess:
        return measured < requirement.limit;
    case Comparison::kAtMost:
        return measured <= requirement.limit;
    case Comparison::kGreater:
        return measured > requirement.limit;
    case Comparison::kAtLeast:
        return measured >= requirement.limit;
    }
    return false;
}

} // namespace

Result<std::vector<Requirement>> parseRequirements(std::string_view text) {
    std::vector<Requirement> requirements;
    for (const std::string_view part : partsOf(text)) {
        auto requirement = requirementFrom(part);
        if (!requirement) {
            return requirement.error();
        }
        requirements.push_back(std::move(*requirement));
    }
    return requirements;
}

std::string_view figureOf(const Requirement& requirement) {
    return nameOf(requirement.figure);
}

bool namesFigure(const std::vector<Requirement>& requirements, std::string_view figure) {
    return std::any_of(requirements.begin(), requirements.end(),
                       [figure](const Requirement& one) { return figureOf(one) == figure; });
}

std::vector<Outcome> check(const std::vector<Requirement>& requirements, const RunResult& result) {
    std::vector<Outcome> outcomes;
    for (const Requirement& requirement : requirements) {
        const auto measured = measuredOf(requirement, result);
        outcomes.push_back({requirement.text, measured, measured && holds(requirement, *measured)});
    }
    return outcomes;
}

std::string wordsOf(const Outcome& outcome) {
    return outcome.measured ? fmt::format("{}: {:.6g}", outcome.requirement, *outcome.measured)
                            : outcome.requirement + ": no sample";
}

double stallMs(const Measured& measured) {
    std::vector<double> waits_ms = measured.samples.interval_ms;
    std::sort(waits_ms.begin(), waits_ms.end(), std::greater<>());
    const double allowed_ms = kStallShare * measured.seconds * 1000;
    // What exceeds a time falls as that grows, and is the most that any of the longest waits
    // together exceed it by: each number of them gives a least time.
    double least_ms = 0;
    double sum_ms = 0;
    for (size_t count = 1; count <= waits_ms.size(); ++count) {
        sum_ms += waits_ms[count - 1];
        least_ms = std::max(least_ms, (sum_ms - allowed_ms) / static_cast<double>(count));
    }
    return least_ms;
}

} // namespace froxel::load
