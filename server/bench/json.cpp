#include "bench/json.h"

#include "bench/published.h"
#include "core/text.h"
#include "report/frame_report.h"
#include "report/frame_step.h"
#include "report/host_summary.h"
#include "report/settings_report.h"
#include "report/statistics.h"
#include "session/placed_lights.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace froxel::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kR1 =
    "every light, on the same device: naive for forward renderers; for deferred renderers their "
    "own G-buffer with the loop over all lights. Any value except 0 is a defect";
constexpr const char* kR2 = "shaded in double on the host, from the triangles that the device "
                            "sees, with independent formulas and texture filtering";
constexpr const char* kLightFormula =
    "on every axis a triangle wave through the box. A hash of seed and index gives its phase and "
    "speed (0.2 to 1.5 m/s in total). The position is a closed-form function of time";

Json toJson(const settings::Size& size) {
    return {size.width_px, size.height_px};
}

Json toJson(const report::Summary& summary) {
    return {{"min", summary.min}, {"p5", summary.p5},   {"median", summary.median},
            {"p95", summary.p95}, {"p99", summary.p99}, {"max", summary.max}};
}

// Null without a sample.
Json summaryOf(const std::vector<double>& samples) {
    return samples.empty() ? Json(nullptr) : toJson(report::summarize(samples));
}

// Tenths: what a run stores of each frame.
Json samplesOf(const std::vector<double>& samples) {
    Json tenths = Json::array();
    for (const double sample : samples) {
        tenths.push_back(std::llround(sample * 10));
    }
    return tenths;
}

Json toJson(const std::vector<RowTimes::Pass>& passes) {
    Json json = Json::array();
    for (const auto& pass : passes) {
        json.push_back({{"name", pass.name},
                        {"frames", pass.frame_count},
                        {"gpu_us", summaryOf(pass.gpu_us)}});
    }
    return json;
}

Json toJson(const image_metrics::DifferenceStats& stats) {
    return {{"max_abs", stats.max_abs},
            {"p999_abs", stats.p999_abs},
            {"rmse", stats.rmse},
            {"relative_rmse", stats.relative_rmse},
            {"psnr_db", std::isfinite(stats.psnr_db) ? Json(stats.psnr_db) : Json(nullptr)},
            {"peak", stats.peak},
            {"pixels", stats.pixel_count},
            {"differing", stats.differing_count},
            {"nonfinite", stats.nonfinite_count}};
}

Json toJson(const image_metrics::PerceivedStats& stats) {
    return {{"above_1_255", stats.above_1_255_count}, {"mssim", stats.mssim}, {"flip", stats.flip}};
}

Json toJson(const std::optional<StreamError>& stream) {
    if (!stream) {
        return nullptr;
    }
    return {{"quality", stream->encoding.quality},
            {"chroma", settings::kChromaNames[static_cast<size_t>(stream->encoding.chroma)]},
            {"bytes", stream->bytes},
            {"bits_per_pixel", stream->bits_per_pixel},
            {"encode_us", toJson(stream->encode_us)},
            {"shown", toJson(stream->shown)},
            {"perceived", toJson(stream->perceived)}};
}

Json toJson(const PictureError& error, const Base& base) {
    if (!error.skipped.empty()) {
        Json json = {{"skipped", error.skipped}};
        for (const char* field : {"size", "exact", "view", "views", "linear", "shown", "perceived",
                                  "hdr_flip", "tile_edge_ratio"}) {
            json[field] = nullptr;
        }
        return json;
    }
    return {
        {"skipped", nullptr},
        {"size", toJson(error.size)},
        {"exact", error.exact()},
        {"view", base.views[error.view].name},
        {"views", error.view_count},
        {"linear", toJson(error.linear)},
        {"shown", toJson(error.shown)},
        {"perceived", toJson(error.perceived)},
        {"hdr_flip", error.hdr_flip},
        {"tile_edge_ratio", error.tile_edge_ratio ? Json(*error.tile_edge_ratio) : Json(nullptr)}};
}

// Rows of one workload draw the same picture, as exactly as their settings allow.
std::string workloadOf(const Row& row, const Base& base) {
    const auto& settings = row.settings;
    const auto& lights = settings.lights;
    const auto size = row.scaled_to.value_or(settings.size);
    std::string text =
        fmt::format("{} lights of {} m, {}x{}, {}, {}", lights.count, numberText(lights.radius_m),
                    size.width_px, size.height_px,
                    settings::kShadingModelNames[static_cast<size_t>(settings.shading)],
                    base.views[row.timedView()].name);
    if (settings.renderer == settings::Renderer::kToonFragment ||
        settings.renderer == settings::Renderer::kToonCompute) {
        text +=
            fmt::format(", {}", settings::kRendererNames[static_cast<size_t>(settings.renderer)]);
    }
    text += settings.exposure_mode == settings::ExposureMode::kFrame ? ", metered exposure" : "";
    text += settings.bloom.kind != settings::BloomKind::kNone ? ", bloom" : "";
    text += row.against == Against::kPeeled ? ", against 16 peeled layers" : "";
    if (const auto& fog = settings.fog; fog.present()) {
        text += fmt::format(", fog of {} a metre{}", numberText(fog.density),
                            fog.height_falloff > 0 ? " by height" : "");
    }
    if (settings.shadows.light_count > 0) {
        text += fmt::format(", shadows of {} lights", settings.shadows.light_count);
    }
    if (const auto placed = settings.lights.placed.lights(); !placed.empty()) {
        text += fmt::format(", {} placed lights", placed.size());
    }
    text += row.against == Against::kSamples ? ", against 64 samples a pixel" : "";
    text += row.against == Against::kFullModel ? ", against the full model" : "";
    return text;
}

Json headOf(const Row& row, size_t frame_count, const CommandOf& command_of) {
    Json json = {{"label", row.label},
                 {"series", row.series},
                 {"value", row.value},
                 {"settings", report::settingsReport(row.settings)},
                 {"command", command_of(row, frame_count)}};
    if (!row.light_set.empty()) { // what the command's file holds
        json["light_set"] = Json::parse(session::lightSetJson(row.settings.lights.placed));
    }
    return json;
}

Json measuredRow(const RunResult& result,
                 const Row& row,
                 const RowResult& found,
                 const CommandOf& command_of) {
    const auto& times = found.times;
    auto json = headOf(row, times.frame_us.size(), command_of);
    json["workload"] = workloadOf(row, result.base);
    json["scaled_to"] = row.scaled_to ? toJson(*row.scaled_to) : Json(nullptr);
    json["frames"] = times.frame_us.size();
    json["gpu_us"] = summaryOf(times.gpu_us);
    json["host_us"] = summaryOf(times.host_us);
    json["frame_us"] = summaryOf(times.frame_us);
    json["cpu_us"] = summaryOf(times.cpu_us);
    json["passes"] = toJson(times.passes);
    json["samples"] = {{"gpu_us", samplesOf(times.gpu_us)},
                       {"host_us", samplesOf(times.host_us)},
                       {"frame_us", samplesOf(times.frame_us)},
                       {"cpu_us", samplesOf(times.cpu_us)}};
    json.update(report::frameReport(times.last));
    json["gbuffer_bytes_per_pixel"] =
        found.gbuffer_bytes_per_pixel ? Json(*found.gbuffer_bytes_per_pixel) : Json(nullptr);
    json["error_r1"] = toJson(found.errors.r1, result.base);
    json["error_r2"] = toJson(found.errors.r2, result.base);
    json["stream"] = toJson(found.stream);
    json["note"] = times.note.empty() ? Json(nullptr) : Json(times.note);
    return json;
}

Json skippedRow(const RunResult& result,
                const Row& row,
                const std::string& reason,
                const CommandOf& command_of) {
    auto json = headOf(row, result.budget.frames_wanted, command_of);
    json["reason"] = reason;
    return json;
}

Json toJson(const RunResult& result, const SweepResult& found, const CommandOf& command_of) {
    const auto& sweep = found.sweep;
    Json rows = Json::array();
    Json skipped = Json::array();
    for (size_t i = 0; i < sweep.rows.size(); ++i) {
        const auto& times = found.rows[i].times;
        if (times.measured()) {
            rows.push_back(measuredRow(result, sweep.rows[i], found.rows[i], command_of));
        } else {
            skipped.push_back(skippedRow(result, sweep.rows[i], times.skipped, command_of));
        }
    }
    return {{"name", sweep.name},
            {"title", sweep.title},
            {"variable", sweep.variable},
            {"unit", sweep.unit},
            {"axis", kAxisNames[static_cast<size_t>(sweep.axis)]},
            {"about", sweep.about},
            {"rows", rows},
            {"skipped", skipped}};
}

Json methodOf(const RunResult& result) {
    const auto& budget = result.budget;
    return {{"seconds_per_row", budget.seconds_per_row},
            {"frames_wanted", budget.frames_wanted},
            {"frames_least", budget.frames_least},
            {"rounds", budget.rounds},
            {"warmup_frames", budget.warmup_frames},
            {"warmup_first", budget.warmup_first},
            {"step_s", report::kFrameStepS},
            {"seed", result.base.settings.lights.seed},
            {"light_formula", kLightFormula},
            {"error_size", toJson(result.error_options.size)},
            {"r1", kR1},
            {"r2", kR2},
            {"r1_pairs_limit", result.error_options.r1_pairs_limit},
            {"r2_pairs_limit", result.error_options.r2_pairs_limit},
            {"peak_linear", image_metrics::DifferenceStats{}.peak},
            {"peak_shown", image_metrics::DifferenceStats{}.peak},
            {"pixels_per_degree", image_metrics::kPixelsPerDegree}};
}

Json viewsOf(const Base& base) {
    Json views = Json::array();
    for (const auto& view : base.views) {
        auto settings = base.settings;
        settings.camera = view.camera;
        views.push_back({{"name", view.name},
                         {"camera", report::settingsReport(settings)["camera"]},
                         {"time_s", view.time_s}});
    }
    return views;
}

} // namespace

nlohmann::ordered_json runReport(const RunResult& result, const CommandOf& command_of) {
    const auto host = report::hostSummary();
    Json sweeps = Json::array();
    for (const auto& sweep : result.sweeps) {
        sweeps.push_back(toJson(result, sweep, command_of));
    }
    return {{"schema", kSchema},
            {"froxel", FROXEL_VERSION},
            {"date", result.date},
            {"complete", result.complete},
            {"elapsed_s", result.elapsed_s},
            {"device", report::toJson(result.device)},
            {"host", {{"cpu", host.cpu}, {"threads", host.thread_count}}},
            {"build", {{"type", host.build_type}, {"compiler", host.compiler}}},
            {"scene",
             {{"source", result.scene_source},
              {"name", result.scene_name},
              {"triangles", result.triangle_count}}},
            {"method", methodOf(result)},
            {"views", viewsOf(result.base)},
            {"sweeps", sweeps},
            {"published", publishedFigures()}};
}

} // namespace froxel::bench
