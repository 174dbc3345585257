#include "app/timings_report.h"

#include "report/frame_report.h"
#include "report/settings_report.h"
#include "report/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

using Json = nlohmann::ordered_json;

// Null without a sample.
Json toJson(std::vector<double> samples) {
    if (samples.empty()) {
        return nullptr;
    }
    const auto summary = report::summarize(std::move(samples));
    return {{"min", summary.min},
            {"median", summary.median},
            {"p95", summary.p95},
            {"max", summary.max}};
}

Json frameTimes(const std::vector<FrameStats>& frames) {
    const auto collect = [&](auto FrameStats::*time) {
        std::vector<double> samples;
        samples.reserve(frames.size());
        for (const auto& frame : frames) {
            if (const std::optional<double> us = frame.*time) {
                samples.push_back(*us);
            }
        }
        return toJson(std::move(samples));
    };
    return {{"gpu_us", collect(&FrameStats::gpu_us)},
            {"host_us", collect(&FrameStats::host_us)},
            {"frame_us", collect(&FrameStats::frame_us)}};
}

Json passTimes(const std::vector<FrameStats>& frames) {
    struct Pass {
        std::string_view name;
        size_t frame_count = 0;
        std::vector<double> gpu_us; // of the frames that tell it
    };
    std::vector<Pass> passes;
    for (const auto& frame : frames) {
        for (const auto& pass : frame.passes) {
            auto known = std::ranges::find(passes, pass.name, &Pass::name);
            if (known == passes.end()) {
                known = passes.insert(known, {pass.name, 0, {}});
            }
            ++known->frame_count;
            if (pass.gpu_us) {
                known->gpu_us.push_back(*pass.gpu_us);
            }
        }
    }
    Json json = Json::array();
    for (auto& pass : passes) {
        json.push_back({{"name", pass.name},
                        {"frames", pass.frame_count},
                        {"gpu_us", toJson(std::move(pass.gpu_us))}});
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
