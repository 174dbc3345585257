#include "app/timings_report.h"

#include "report/frame_report.h"
#include "report/settings_report.h"
#include "report/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(std::vector<double> samples) {
    const auto summary = report::summarize(std::move(samples));
    return {{"min", summary.min},
            {"median", summary.median},
            {"p95", summary.p95},
            {"max", summary.max}};
}

Json frameTimes(const std::vector<FrameStats>& frames) {
    const auto collect = [&](double FrameStats::*time) {
        std::vector<double> samples;
        samples.reserve(frames.size());
        for (const auto& frame : frames) {
            samples.push_back(frame.*time);
        }
        return toJson(std::move(samples));
    };
    return {{"gpu_us", collect(&FrameStats::gpu_us)},
            {"host_us", collect(&FrameStats::host_us)},
            {"frame_us", collect(&FrameStats::frame_us)}};
}

Json passTimes(const std::vector<FrameStats>& frames) {
    std::vector<std::pair<std::string_view, std::vector<double>>> passes;
    for (const auto& frame : frames) {
        for (const auto& pass : frame.passes) {
            auto known = std::find_if(passes.begin(), passes.end(),
                                      [&](const auto& entry) { return entry.first == pass.name; });
            if (known == passes.end()) {
                known = passes.insert(known, {pass.name, {}});
            }
            known->second.push_back(pass.gpu_us);
        }
    }
    Json json = Json::array();
    for (auto& [name, samples] : passes) {
        const size_t count = samples.size();
        json.push_back({{"name", name}, {"frames", count}, {"gpu_us", toJson(std::move(samples))}});
    }
    return json;
}

} // namespace

Json timingsReport(const TimedRun& run) {
    return {{"schema", "froxel.timings.v1"},
            {"froxel", FROXEL_VERSION},
            {"device", report::toJson(run.device)},
            {"host", {{"threads", std::thread::hardware_concurrency()}}},
            {"scene", run.scene},
            {"settings", report::settingsReport(run.settings)},
            {"frames", run.frames.size()},
            {"warmup_frames", run.warmup_count},
            {"time_s", run.time_s},
            {"step_s", run.step_s},
            {"frame", frameTimes(run.frames)},
            {"passes", passTimes(run.frames)},
            {"last_frame", report::frameReport(run.frames.back())}};
}

} // namespace froxel::app
