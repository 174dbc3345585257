#include "app/load_report.h"

#include "app/load_verdict.h"
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

void append(std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// `seconds` becomes the run's.
ViewerResult pool(const RunResult& result) {
    ViewerResult all;
    all.measured.seconds = result.seconds;
    for (const ViewerResult& viewer : result.viewers) {
        const Measured& one = viewer.measured;
        Measured& sum = all.measured;
        append(sum.samples.latency_ms, one.samples.latency_ms);
        append(sum.samples.reaction_ms, one.samples.reaction_ms);
        append(sum.samples.age_ms, one.samples.age_ms);
        append(sum.samples.interval_ms, one.samples.interval_ms);
        for (size_t stage = 0; stage < load::kStageNames.size(); ++stage) {
            append(sum.samples.stage_ms[stage], one.samples.stage_ms[stage]);
        }
        append(sum.samples.gpu_ms, one.samples.gpu_ms);
        append(sum.samples.timer_lag_ms, one.samples.timer_lag_ms);
        sum.frames += one.frames;
        sum.frame_bytes += one.frame_bytes;
        sum.server_dropped += one.server_dropped;
        sum.client_dropped += one.client_dropped;
        sum.commands += one.commands;
        sum.commands_skipped += one.commands_skipped;
        sum.commands_unshown += one.commands_unshown;
        for (const auto& size : {one.smallest, one.largest}) {
            if (size) {
                sum.addSize(*size);
            }
        }
        for (const auto& [code, count] : one.refusals) {
            sum.refusals[code] += count;
        }
        sum.refusal = sum.refusal ? sum.refusal : one.refusal;
        all.received_bytes += viewer.received_bytes;
        all.sent_bytes += viewer.sent_bytes;
        all.key_frames += viewer.key_frames;
    }
    return all;
}

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

// What was measured, each different one once, with the viewers that were served so.
Json servedOf(const RunResult& result) {
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

uint64_t refusalCount(const Measured& measured) {
    uint64_t count = 0;
    for (const auto& [code, of_code] : measured.refusals) {
        count += of_code;
    }
    return count;
}

Json figuresOf(const ViewerResult& viewer) {
    const Measured& measured = viewer.measured;
    const load::Samples& samples = measured.samples;
    Json stages = Json::object();
    for (size_t stage = 0; stage < load::kStageNames.size(); ++stage) {
        stages[std::string(load::kStageNames[stage])] = summaryOf(samples.stage_ms[stage]);
    }
    Json by_code = Json::object();
    for (const auto& [code, count] : measured.refusals) {
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
            {"smallest_picture", sizeOf(measured.smallest)},
            {"largest_picture", sizeOf(measured.largest)},
            {"server_dropped", measured.server_dropped},
            {"client_dropped", measured.client_dropped},
            {"commands", measured.commands},
            {"commands_skipped", measured.commands_skipped},
            {"commands_unshown", measured.commands_unshown},
            {"refusals", refusalCount(measured)},
            {"refusals_by_code", std::move(by_code)},
            {"refusal", orNull(measured.refusal)}};
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
        measured.server_dropped + measured.client_dropped, refusalCount(measured));
}

std::string stagesLine(const ViewerResult& all) {
    const load::Samples& samples = all.measured.samples;
    std::string line = "median ms:";
    for (size_t stage = 0; stage < load::kStageNames.size(); ++stage) {
        line += fmt::format("  {} {}", load::kStageNames[stage],
                            shown(samples.stage_ms[stage], &report::Summary::median));
    }
    return line + fmt::format("  (gpu {})\n", shown(samples.gpu_ms, &report::Summary::median));
}

} // namespace

Json loadReport(const LoadOptions& options, const RunResult& result) {
    Json each = Json::array();
    for (const ViewerResult& viewer : result.viewers) {
        Json figures = {{"failure", orNull(viewer.failure)},
                        {"first_frame_ms", orNull(viewer.first_frame_ms)},
                        {"stall_ms", stallMs(viewer.measured)}};
        figures.update(figuresOf(viewer));
        each.push_back(std::move(figures));
    }
    const auto& size = options.size;
    return {{"schema", "froxel.load.v1"},
            {"froxel", FROXEL_VERSION},
            {"url", options.url},
            {"script", std::filesystem::path(options.script).filename().string()},
            {"room", options.room.empty() ? Json(nullptr) : Json(options.room)},
            {"viewers", options.viewer_count},
            {"seconds", options.seconds},
            {"ramp_s", options.ramp_s},
            {"size", size ? Json{{"width_px", size->width_px}, {"height_px", size->height_px}}
                          : Json(nullptr)},
            {"lights", orNull(options.light_count)},
            {"codec", settings::rowOf(options.codec).name},
            {"video_kbps", orNull(options.video_kbps)},
            {"served", servedOf(result)},
            {"host", {{"threads", std::thread::hardware_concurrency()}}},
            {"measured_s", result.seconds},
            {"stopped", result.stopped},
            {"bounds",
             {{"max_latency_ms", orNull(options.max_latency_ms)},
              {"min_fps", orNull(options.min_fps)}}},
            {"broken", orNull(loadVerdict(options, result))},
            {"all", figuresOf(pool(result))},
            {"each", std::move(each)}};
}

std::string loadTable(const RunResult& result) {
    const ViewerResult all = pool(result);
    const bool nobody =
        std::none_of(result.viewers.begin(), result.viewers.end(),
                     [](const ViewerResult& viewer) { return viewer.measured.seconds > 0; });
    if (nobody) {
        return {};
    }
    std::string table = fmt::format("viewers: {}, measured for {:.1f} s{}\n", result.viewers.size(),
                                    result.seconds, result.stopped ? " (stopped)" : "");
    table += "                 latency ms                reaction ms      age ms   jitter\n"
             "viewer  frames/s       p50     p95     p99       p50     p95      p99       ms"
             "    Mbit/s  dropped  refused\n";
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
    if (all.measured.refusal) {
        table += fmt::format("first refusal: {}\n", *all.measured.refusal);
    }
    return table;
}

std::string loadProgress(const LoadOptions& options,
                         const load::RunProgress& now,
                         const load::RunProgress& before) {
    if (!now.measuring) {
        return fmt::format("joining: {} of {} viewers, {} failed", now.joined, options.viewer_count,
                           now.ended);
    }
    // The first line of measuring follows one of joining, with a clock of its own.
    const double since =
        before.measuring ? (now.elapsed - before.elapsed).count() : now.elapsed.count();
    const auto rate = [since](uint64_t from, uint64_t to) {
        return perSecond(static_cast<double>(to - from), since);
    };
    return fmt::format("{:.0f} of {} s, {} viewers, {:.0f} frames/s, {:.1f} Mbit/s",
                       now.elapsed.count(), options.seconds, options.viewer_count - now.ended,
                       rate(before.frames, now.frames), rate(before.bytes, now.bytes) * 8 / 1e6);
}

} // namespace froxel::app
