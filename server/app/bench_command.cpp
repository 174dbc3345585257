#include "app/bench_command.h"

#include "app/camera_path_option.h"
#include "app/environment_file.h"
#include "app/output_file.h"
#include "app/report_page.h"
#include "app/row_command.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "bench/compare.h"
#include "bench/html.h"
#include "bench/join.h"
#include "bench/json.h"
#include "bench/presets.h"
#include "bench/run.h"
#include "net/stop_signal.h"
#include "render/view/renderer.h"
#include "report/device_summary.h"
#include "session/session_context.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

constexpr settings::Size kUsual; // sweeps draw pictures of its shape
constexpr size_t kDefaultViews = 3;
constexpr double kViewStepS = 5; // of the lights' clock, from one view to the next

// A signal as a flag that drawing looks at between frames. A second one ends the process.
class StopFlag {
  public:
    StopFlag() : thread_([this] { stopped_ = signal_.wait() != 0; }) {}
    ~StopFlag() { signal_.request(); }
    StopFlag(const StopFlag&) = delete;
    StopFlag& operator=(const StopFlag&) = delete;
    [[nodiscard]] const std::atomic<bool>& stopped() const { return stopped_; }

  private:
    net::StopSignal signal_;
    std::atomic<bool> stopped_ = false;
    std::jthread thread_; // last: joins before the signal goes
};

std::vector<bench::View> viewsOfCameras(const BenchOptions& options, const scene::Scene& scene) {
    auto names = options.cameras;
    for (const auto& camera : scene.cameras) {
        const auto parsed =
            parseCamera(camera.name); // a name that reads as numbers cannot be asked for
        if (options.cameras.empty() && names.size() < kDefaultViews && parsed &&
            std::holds_alternative<std::string>(*parsed)) {
            names.push_back(camera.name);
        }
    }
    if (names.empty()) {
        names.emplace_back();
    }
    std::vector<bench::View> views;
    for (const auto& name : names) {
        const auto choice = name.empty() ? CameraChoice{} : parseCamera(name).value();
        views.push_back({name, findCamera(choice, scene, kUsual).value(),
                         static_cast<double>(views.size()) * kViewStepS});
    }
    return views;
}

// By the name that --camera takes, which keeps cameras upright.
bench::View viewAlong(const path::CameraPath& path, double at_s) {
    const settings::Camera camera = path.at(at_s);
    const std::string name = cameraText(camera);
    const auto named = std::get<settings::Camera>(parseCamera(name).value());
    constexpr double kRolled = 1e-6;
    if (glm::distance(named.world_from_view[1], camera.world_from_view[1]) > kRolled) {
        throw StartupError(
            {ErrorCode::kInvalidArgument,
             fmt::format(
                 "--path: the camera is not upright at {:.3g} s; bench needs an upright one",
                 at_s)});
    }
    return {name, named, at_s};
}

// At even times, and at both ends unless it is a loop, whose end is its beginning.
std::vector<bench::View> viewsAlong(const path::CameraPath& path, uint32_t stops) {
    const uint32_t steps = path.keys().loop ? stops : std::max(1U, stops - 1);
    std::vector<bench::View> views;
    for (uint32_t i = 0; i < stops; ++i) {
        views.push_back(viewAlong(path, path.seconds() * i / steps));
    }
    return views;
}

std::vector<bench::View> viewsOf(const BenchOptions& options, const scene::Scene& scene) {
    if (options.path.empty()) {
        return viewsOfCameras(options, scene);
    }
    const auto first = findCamera({}, scene, kUsual).value();
    return viewsAlong(readCameraPath(options.path, scene, first, options.path_seconds).value(),
                      options.path_stops);
}

std::string nowUtc() {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

bench::ErrorOptions errorOptionsOf(const BenchOptions& options, bool device_is_cpu) {
    auto errors = bench::errorOptionsFor(device_is_cpu);
    errors.size = options.error_size;
    errors.r1_pairs_limit = options.r1_pairs_limit.value_or(errors.r1_pairs_limit);
    errors.r2_pairs_limit = options.r2_pairs_limit.value_or(errors.r2_pairs_limit);
    return errors;
}

// What is known before anything is measured.
bench::RunResult
startOf(const BenchOptions& options, const scene::Scene& scene, const gpu::DeviceTraits& device) {
    const auto summary = session::summarize(scene);
    bench::RunResult result;
    result.date = nowUtc();
    result.device = report::summarize(device);
    result.scene_source = options.scene;
    result.scene_name = summary.name;
    result.triangle_count = summary.triangle_count;
    result.budget = bench::budgetFor(device.is_cpu, options.seconds_per_row);
    result.error_options = errorOptionsOf(options, device.is_cpu);
    result.base = {options.settings, viewsOf(options, scene), scene.material_variants};
    return result;
}

int listPresets(const BenchOptions& options) {
    const bench::Base base{options.settings, std::vector<bench::View>(1)};
    for (const auto name : bench::presetNames()) {
        const auto sweep = bench::makeSweep(name, base);
        fmt::print("{:<18}{:>4} rows  {}\n", name, sweep.rows.size(), sweep.title);
    }
    return 0;
}

nlohmann::ordered_json readReport(const std::filesystem::path& path) {
    const auto text = readText(path).value();
    auto report = nlohmann::ordered_json::parse(text, nullptr, false);
    if (report.is_discarded()) {
        throw StartupError(
            {ErrorCode::kInvalidArgument, fmt::format("'{}' is not JSON", path.string())});
    }
    return report;
}

int compareFiles(const BenchOptions& options) {
    const auto comparison =
        bench::compareReports(readReport(options.compare[0]), readReport(options.compare[1]))
            .value();
    std::fputs(bench::toText(comparison).c_str(), stdout);
    return comparison.worse() ? 1 : 0;
}

void writeReport(const BenchOptions& options,
                 const std::string& page,
                 const nlohmann::ordered_json& report) {
    writeText(options.out, report.dump() + "\n");
    if (!options.report.empty()) {
        writeText(options.report, bench::fillReport(page, report).value());
    }
}

int joinFiles(const BenchOptions& options, const std::string& page) {
    std::vector<nlohmann::ordered_json> reports;
    for (const auto& path : options.join) {
        reports.push_back(readReport(path));
    }
    writeReport(options, page, bench::joinReports(reports).value());
    return 0;
}

void printSummary(const bench::RunResult& result) {
    size_t measured = 0;
    size_t skipped = 0;
    for (const auto& sweep : result.sweeps) {
        for (const auto& row : sweep.rows) {
            (row.times.measured() ? measured : skipped) += 1;
        }
    }
    fmt::print("{} rows measured, {} left out, {:.0f} s{}\n", measured, skipped, result.elapsed_s,
               result.complete ? "" : "; stopped early");
}

std::vector<bench::Sweep> sweepsOf(const BenchOptions& options, const bench::Base& base) {
    std::vector<bench::Sweep> sweeps;
    for (const auto name : bench::fullPresetNames()) {
        if (options.presets.empty()) {
            sweeps.push_back(bench::makeSweep(name, base));
        }
    }
    for (const auto& name : options.presets) {
        sweeps.push_back(bench::makeSweep(name, base));
    }
    return sweeps;
}

// Which make loading longer.
bool drawsLevels(const BenchOptions& options) {
    return options.settings.geometry_error_px > 0 ||
           std::ranges::find(options.presets, "geometry_error") != options.presets.end();
}

int measureSweeps(const BenchOptions& options, const std::string& page) {
    const StopFlag stop;
    auto scene = loadScene(options.scene).value();
    surround(scene, readSurroundings(options.environment_file));
    gpu::Device device(options.device);
    render::Renderer renderer(device, scene, {},
                              {.detail_levels = drawsLevels(options),
                               .geometry_cache = options.device.pipeline_cache.folder});
    logWarnings(scene);
    bench::Run run(renderer, scene, startOf(options, scene, device.traits()), stop.stopped());
    run.measure(sweepsOf(options, run.result().base), [&](const bench::RunResult& result) {
        const auto command_of = [&](const bench::Row& row, size_t frame_count) {
            return rowCommand(options, result, row, frame_count);
        };
        writeReport(options, page, bench::runReport(result, command_of));
    });
    printSummary(run.result());
    const auto inexact = bench::inexactRows(run.result());
    for (const auto& line : inexact) {
        fmt::print(stderr, "froxel: {}\n", line);
    }
    if (!inexact.empty()) {
        return 1;
    }
    return run.result().complete ? 0 : kStoppedExitCode;
}

} // namespace

int runBench(const BenchOptions& options) try {
    if (options.list) {
        return listPresets(options);
    }
    if (!options.compare.empty()) {
        return compareFiles(options);
    }
    requireFolderOf(options.out);
    std::string page;
    if (!options.report.empty()) {
        requireFolderOf(options.report);
        page = readReportPage(options.web_root, "report.html");
    }
    if (!options.join.empty()) {
        return joinFiles(options, page);
    }
    return measureSweeps(options, page);
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
