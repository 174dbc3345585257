#include "app/load_verdict.h"

#include "report/statistics.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace froxel::app {
namespace {

using load::RunResult;
using load::ViewerResult;

constexpr double kStallShare = 0.05; // of the measured time that may lie beyond a stall

// How many break one bound, and the worst of them.
struct Breach {
    size_t count = 0;
    size_t number = 0; // of the worst viewer, from 1
    std::string words;
};

std::string breachText(const Breach& breach, size_t viewer_count, const std::string& bound) {
    return fmt::format("{} of {} viewers broke {}: viewer {} {}", breach.count, viewer_count, bound,
                       breach.number, breach.words);
}

// What --max-latency-ms is of, and which of the three it is.
std::pair<double, const char*> worstOf(const ViewerResult& viewer) {
    const load::Samples& samples = viewer.measured.samples;
    std::pair<double, const char*> worst{stallMs(viewer.measured), "stalled for"};
    const auto consider = [&worst](const std::vector<double>& times_ms, const char* words) {
        const double p95_ms = times_ms.empty() ? 0 : report::summarize(times_ms).p95;
        worst = p95_ms >= worst.first ? std::pair{p95_ms, words} : worst;
    };
    consider(samples.reaction_ms, "has a p95 reaction of");
    consider(samples.latency_ms, "has p95");
    return worst;
}

std::optional<std::string> latencyBreach(const RunResult& result, double limit_ms) {
    Breach breach;
    double most_ms = limit_ms;
    for (size_t index = 0; index < result.viewers.size(); ++index) {
        const ViewerResult& viewer = result.viewers[index];
        const bool none = viewer.controlled && viewer.measured.samples.latency_ms.empty();
        const auto [time_ms, words] = worstOf(viewer);
        if (!none && time_ms <= limit_ms) {
            continue;
        }
        ++breach.count;
        if (time_ms > most_ms) {
            breach.number = index + 1;
            breach.words = fmt::format("{} {:.1f} ms", words, time_ms);
            most_ms = time_ms;
        } else if (breach.number == 0) {
            breach.number = index + 1;
            breach.words = "measured no latency";
        }
    }
    if (breach.count == 0) {
        return std::nullopt;
    }
    return breachText(breach, result.viewers.size(), fmt::format("--max-latency-ms {}", limit_ms));
}

std::optional<std::string> rateBreach(const RunResult& result, double limit) {
    Breach breach;
    double worst = limit;
    for (size_t index = 0; index < result.viewers.size(); ++index) {
        const double rate = result.viewers[index].measured.framesPerSecond();
        if (rate >= limit) {
            continue;
        }
        ++breach.count;
        if (rate < worst) {
            worst = rate;
            breach.number = index + 1;
            breach.words = fmt::format("has {:.1f} frames/s", rate);
        }
    }
    if (breach.count == 0) {
        return std::nullopt;
    }
    return breachText(breach, result.viewers.size(), fmt::format("--min-fps {}", limit));
}

} // namespace

double stallMs(const load::Measured& measured) {
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

std::optional<std::string> loadVerdict(const LoadOptions& options, const RunResult& result) {
    std::vector<std::string> faults;
    const auto failed = [](const ViewerResult& viewer) { return viewer.failure.has_value(); };
    const auto first = std::find_if(result.viewers.begin(), result.viewers.end(), failed);
    if (first != result.viewers.end()) {
        faults.push_back(
            fmt::format("{} of {} viewers failed: viewer {}: {}",
                        std::count_if(result.viewers.begin(), result.viewers.end(), failed),
                        result.viewers.size(), std::distance(result.viewers.begin(), first) + 1,
                        *first->failure));
    }
    const auto add = [&faults](std::optional<std::string> fault) {
        if (fault) {
            faults.push_back(std::move(*fault));
        }
    };
    add(options.max_latency_ms ? latencyBreach(result, *options.max_latency_ms) : std::nullopt);
    add(options.min_fps ? rateBreach(result, *options.min_fps) : std::nullopt);
    return faults.empty() ? std::nullopt
                          : std::optional(fmt::format("{}", fmt::join(faults, "; ")));
}

} // namespace froxel::app
