#include "app/load_report.h"

#include "load/requirement.h"
#include "report/statistics.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

namespace froxel::app {
namespace {

using Json = nlohmann::ordered_json;
using load::Measured;
using load::RunResult;
using load::ViewerResult;

// More viewers than this are not listed one by one.
constexpr size_t kListedViewers = 16;

double perSecond(double amount, double seconds) {
    return seconds > 0 ? amount / seconds : 0;
}

double byteRate(const ViewerResult& viewer) {
    return perSecond(static_cast<double>(viewer.received_bytes), viewer.measured.seconds);
}

Json summaryOf(const std::vector<double>& samples) {
    if (samples.empty()) {
        return nullptr;
    }
    const auto summary = report::summarize(samples);
    return {{"count", summary.count}, {"min", summary.min}, {"median", summary.median},
            {"p95", summary.p95},     {"p99", summary.p99}, {"max", summary.max},
            {"mean", summary.mean}};
}

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json sizeOf(const std::optional<load::PictureSize>& size) {
    return size ? Json{{"width_px", size->width_px}, {"height_px", size->height_px}}
                : Json(nullptr);
}

Json figuresOf(const ViewerResult& viewer) {
    const Measured& measured = viewer.measured;
    const load::Samples& samples = measured.samples;
    Json stages = Json::object();
    for (const load::SampleSeries& series : load::kSampleSeries) {
        if (series.is_stage) {
            stages[std::string(series.name)] = summaryOf(samples.*series.samples);
        }
    }
    Json by_code = Json::object();
    for (const auto& [code, count] : measured.errors_by_code) {
        by_code[v1::ErrorCode_Name(code)] = count;
    }
    const Json intervals = summaryOf(samples.interval_ms);
    return {{"frames", measured.frames},
            {"frames_per_s", measured.framesPerSecond()},
            {"latency_ms", summaryOf(samples.latency_ms)},
            {"reaction_ms", summaryOf(samples.reaction_ms)},
            {"age_ms", summaryOf(samples.age_ms)},
            {"interval_ms", intervals},
            {"jitter_ms", intervals.is_null() ? Json(nullptr)
                                              : Json(intervals["p99"].get<double>() -
                                                     intervals["median"].get<double>())},
            {"stages_ms", std::move(stages)},
            {"gpu_ms", summaryOf(samples.gpu_ms)},
            {"timer_lag_ms", summaryOf(samples.timer_lag_ms)},
            {"received_bytes", viewer.received_bytes},
            {"sent_bytes", viewer.sent_bytes},
            {"key_frames", viewer.key_frames},
            {"received_bytes_per_s", byteRate(viewer)},
            {"frame_bytes", measured.frame_bytes},
            {"depth_meshes", measured.depth_meshes},
            {"depth_bytes", measured.depth_bytes},
            {"smallest_picture", sizeOf(measured.smallest)},
            {"largest_picture", sizeOf(measured.largest)},
            {"server_dropped", measured.server_dropped},
            {"client_dropped", measured.client_dropped},
            {"commands", measured.commands},
            {"commands_skipped", measured.commands_skipped},
            {"commands_unshown", measured.commands_unshown},
            {"errors", measured.errors},
            {"errors_by_code", std::move(by_code)},
            {"first_error", orNull(measured.first_error)}};
}

// "12.3", or "-" without a sample.
std::string shown(const std::vector<double>& samples, double report::Summary::*figure) {
    return samples.empty() ? "-" : fmt::format("{:.1f}", report::summarize(samples).*figure);
}

std::string rowOf(const std::string& name, const ViewerResult& viewer) {
    using report::Summary;
    const Measured& measured = viewer.measured;
    const load::Samples& samples = measured.samples;
    std::string jitter = "-";
    if (!samples.interval_ms.empty()) {
        const auto interval = report::summarize(samples.interval_ms);
        jitter = fmt::format("{:.1f}", interval.p99 - interval.median);
    }
    return fmt::format(
        "{:>6} {:>9.1f} {:>9} {:>7} {:>7} {:>9} {:>7} {:>8} {:>8} {:>9.3f} {:>8} {:>8}\n", name,
        measured.framesPerSecond(), shown(samples.latency_ms, &Summary::median),
        shown(samples.latency_ms, &Summary::p95), shown(samples.latency_ms, &Summary::p99),
        shown(samples.reaction_ms, &Summary::median), shown(samples.reaction_ms, &Summary::p95),
        shown(samples.age_ms, &Summary::p99), jitter, byteRate(viewer) * 8 / 1e6,
        measured.server_dropped + measured.client_dropped, measured.errors);
}

std::string stagesLine(const ViewerResult& all) {
    const load::Samples& samples = all.measured.samples;
    std::string line = "median ms:";
    for (const load::SampleSeries& series : load::kSampleSeries) {
        if (series.is_stage) {
            line += fmt::format("  {} {}", series.name,
                                shown(samples.*series.samples, &report::Summary::median));
        }
    }
    return line + fmt::format("  (gpu {})\n", shown(samples.gpu_ms, &report::Summary::median));
}

Json stagesOf(const LoadOptions& options) {
    if (options.stages.empty()) {
        return nullptr;
    }
    Json stages = Json::array();
    for (const load::Stage& stage : options.stages) {
        stages.push_back({{"seconds", stage.length.count()}, {"viewers", stage.viewers}});
    }
    return stages;
}

Json scriptsOf(const load::RunOptions& run) {
    Json scripts = Json::array();
    for (const load::ScriptShare& script : run.scripts) {
        scripts.push_back({{"name", script.name}, {"share", script.share}});
    }
    return scripts;
}

// "40 of 50", or "50" where nobody failed.
std::string servedText(const RunResult& result) {
    const auto failed =
        std::count_if(result.viewers.begin(), result.viewers.end(),
                      [](const ViewerResult& viewer) { return viewer.failure.has_value(); });
    return failed == 0
               ? fmt::format("{}", result.viewers.size())
               : fmt::format("{} of {}", result.viewers.size() - static_cast<size_t>(failed),
                             result.viewers.size());
}

} // namespace

Json servedKinds(const RunResult& result) {
    std::vector<std::pair<load::Served, size_t>> kinds;
    for (const ViewerResult& viewer : result.viewers) {
        if (!viewer.served) {
            continue;
        }
        const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) {
            return kind.first == *viewer.served;
        });
        if (known != kinds.end()) {
            ++known->second;
        } else {
            kinds.emplace_back(*viewer.served, 1);
        }
    }
    Json all = Json::array();
    for (const auto& [served, count] : kinds) {
        all.push_back({{"viewers", count},
                       {"server_version", served.server_version},
                       {"device", served.device},
                       {"scene", served.scene},
                       {"triangles", served.triangle_count},
                       {"size", sizeOf(load::PictureSize{served.width_px, served.height_px})},
                       {"lights", served.light_count},
                       {"lights_move", served.lights_move},
                       {"renderer", served.renderer},
                       {"codec", served.codec},
                       {"quality", served.quality},
                       {"video_kbps", served.video_kbps}});
    }
    return all;
}

Json outcomesOf(const std::vector<load::Outcome>& checked) {
    Json outcomes = Json::array();
    for (const load::Outcome& outcome : checked) {
        outcomes.push_back({{"requirement", outcome.requirement},
                            {"measured", orNull(outcome.measured)},
                            {"held", outcome.held}});
    }
    return outcomes;
}

Json loadSetup(const LoadOptions& options, const load::RunOptions& run) {
    const auto& size = options.size;
    Json think = nullptr;
    if (options.think) {
        think = {{"least_s", options.think->least.count()},
                 {"most_s", options.think->most.count()}};
    }
    return {{"froxel", FROXEL_VERSION},
            {"url", options.url},
            {"scripts", scriptsOf(run)},
            {"think", std::move(think)},
            {"room", options.room.empty() ? Json(nullptr) : Json(options.room)},
            {"seconds", run.seconds.count()},
            {"ramp_s", options.ramp_s},
            {"stages", stagesOf(options)},
            {"size", size ? Json{{"width_px", size->width_px}, {"height_px", size->height_px}}
                          : Json(nullptr)},
            {"lights", orNull(options.light_count)},
            {"codec", settings::rowOf(options.codec).name},
            {"video_kbps", orNull(options.video_kbps)},
            {"host", {{"threads", std::thread::hardware_concurrency()}}},
            {"threads", run.thread_count}};
}

Json loadReport(const LoadOptions& options,
                const load::RunOptions& run,
                const RunResult& result,
                const LoadVerdict& verdict,
                const std::vector<SeriesRow>& series) {
    Json each = Json::array();
    for (const ViewerResult& viewer : result.viewers) {
        Json figures = {{"failure", orNull(viewer.failure)},
                        {"refused", viewer.refused},
                        {"first_frame_ms", orNull(viewer.first_frame_ms)},
                        {"first_frame_wait_ms", orNull(viewer.first_frame_wait_ms)},
                        {"stall_ms", load::stallMs(viewer.measured)}};
        figures.update(figuresOf(viewer));
        each.push_back(std::move(figures));
    }
    Json rows = Json::array();
    for (const SeriesRow& row : series) {
        rows.push_back(jsonOf(row));
    }
    Json report = {{"schema", "froxel.load.v2"}};
    report.update(loadSetup(options, run));
    report.update({{"viewers", result.viewers.size()},
                   {"served", servedKinds(result)},
                   {"measured_s", result.seconds},
                   {"stopped", result.stopped},
                   {"ended_early", result.ended_early},
                   {"busy_cores", result.busy_cores},
                   {"requirements", outcomesOf(verdict.outcomes)},
                   {"broken", orNull(brokenLine(verdict))},
                   {"all", figuresOf(load::pool(result))},
                   {"each", std::move(each)},
                   {"series", std::move(rows)}});
    return report;
}

std::string loadTable(const RunResult& result, const LoadVerdict& verdict) {
    const ViewerResult all = load::pool(result);
    const bool nobody =
        std::none_of(result.viewers.begin(), result.viewers.end(),
                     [](const ViewerResult& viewer) { return viewer.measured.seconds > 0; });
    if (nobody) {
        return {};
    }
    std::string table =
        fmt::format("viewers: {}, measured for {:.1f} s{}\n", servedText(result), result.seconds,
                    result.stopped       ? " (stopped)"
                    : result.ended_early ? " (ended early)"
                                         : "");
    table += "                 latency ms                reaction ms      age ms   jitter\n"
             "viewer  frames/s       p50     p95     p99       p50     p95      p99       ms"
             "    Mbit/s  dropped   errors\n";
    table += rowOf("all", all);
    if (result.viewers.size() <= kListedViewers) {
        for (size_t index = 0; index < result.viewers.size(); ++index) {
            table += rowOf(fmt::format("{}", index + 1), result.viewers[index]);
        }
    }
    table += stagesLine(all);
    table += fmt::format("longest wait for a due frame: {} ms; commands that no frame showed: {}\n",
                         shown(all.measured.samples.interval_ms, &report::Summary::max),
                         all.measured.commands_unshown);
    table += fmt::format("this client: {:.1f} of the host's {} cores\n", result.busy_cores,
                         std::thread::hardware_concurrency());
    if (all.measured.first_error) {
        table += fmt::format("first error: {}\n", *all.measured.first_error);
    }
    for (const load::Outcome& outcome : verdict.outcomes) {
        table +=
            fmt::format("{}  {}\n", outcome.held ? "held  " : "broken", load::wordsOf(outcome));
    }
    return table;
}

std::string
loadProgress(const load::RunOptions& run, const load::RunSecond& second, const SeriesRow& row) {
    const auto whole = [&row](std::string_view column) {
        return static_cast<uint64_t>(valueIn(row, column).value_or(0));
    };
    if (!second.measuring) {
        return fmt::format("joining: {} of {} viewers, {} failed", second.joined, run.visits.size(),
                           second.ended);
    }
    return fmt::format(
        "{:.0f} s, {} viewers, {} joining, {} failed, {:.0f} frames/s, {:.1f} Mbit/s",
        second.elapsed.count(), whole("viewers"), whole("joining"),
        whole("refused") + whole("failed"), valueIn(row, "frames_per_s").value_or(0),
        valueIn(row, "mbit_per_s").value_or(0));
}

} // namespace froxel::app
