#include "app/bench_command.h"

#include "app/bench_compare.h"
#include "app/bench_html.h"
#include "app/bench_join.h"
#include "app/bench_json.h"
#include "app/bench_presets.h"
#include "app/output_file.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "net/stop_signal.h"
#include "render/gbuffer_layout.h"
#include "render/renderer.h"
#include "render/scene_needs.h"
#include "session/session_context.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

// Seconds of one row's reference, about: 9 ns a pair on two cores of a CPU device, a few ps in a
// GPU's compute stage (70 in its fragment stage).
constexpr double kR1PairsCpu = 2e9;
constexpr double kR1PairsGpu = 1e11;
constexpr double kR2PairsPerThread = 1e9;

constexpr size_t kEncodeCount = 20;
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

std::vector<BenchView> viewsOf(const BenchOptions& options, const scene::Scene& scene) {
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
    std::vector<BenchView> views;
    for (const auto& name : names) {
        const auto choice = name.empty() ? CameraChoice{} : parseCamera(name).value();
        views.push_back({name, findCamera(choice, scene).value(),
                         static_cast<double>(views.size()) * kViewStepS});
    }
    return views;
}

std::string nowUtc() {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

bool isDeferred(view::Renderer renderer) {
    return renderer != view::Renderer::kNaive && renderer != view::Renderer::kForwardPlus;
}

std::optional<uint32_t> gbufferBytes(const view::ViewSettings& settings,
                                     const render::SceneNeeds& needs) {
    if (!isDeferred(settings.renderer)) {
        return std::nullopt;
    }
    const bool lambert = settings.shading == view::ShadingModel::kLambert;
    return render::gbufferBytesPerPixel(settings.gbuffer,
                                        lambert ? needs.wide_lambert : needs.wide_gbuffer);
}

// A run's parts, in the order they are made.
class BenchRun {
  public:
    BenchRun(const BenchOptions& options, const std::atomic<bool>& stop)
        : options_(options), stop_(stop), scene_(loadScene(options.scene).value()),
          needs_(render::findNeeds(scene_)), device_(options.device), renderer_(device_, scene_) {
        for (const auto& warning : scene_.warnings) {
            spdlog::warn("scene {}", warning);
        }
        const auto& traits = device_.traits();
        result_.date = nowUtc();
        result_.device = summarize(traits);
        result_.device_choice = options.device.choice;
        result_.scene_source = options.scene;
        result_.light_set = options.light_set;
        const auto summary = session::summarize(scene_);
        result_.scene_name = summary.name;
        result_.triangle_count = summary.triangle_count;
        result_.budget = budgetFor(traits.is_cpu, options.seconds_per_row);
        const double threads = std::max(1U, std::thread::hardware_concurrency());
        result_.error_options = {
            options.error_size,
            options.r1_pairs_limit.value_or(traits.is_cpu ? kR1PairsCpu : kR1PairsGpu),
            options.r2_pairs_limit.value_or(kR2PairsPerThread * threads)};
        result_.base = {options.settings, viewsOf(options, scene_)};
    }

    [[nodiscard]] const BenchResult& result() const { return result_; }

    // `save` is called after every sweep.
    template <class Save>
    void measure(std::vector<Sweep> sweeps, const Save& save) {
        size_t row_count = 0;
        for (const auto& sweep : sweeps) {
            row_count += sweep.rows.size();
        }
        BenchProgress progress(static_cast<double>(row_count));
        BenchRunner runner(renderer_, result_.budget, stop_, progress);
        ErrorMeter meter(renderer_, scene_, result_.base, result_.error_options, stop_);
        const auto start = Clock::now();
        for (auto& sweep : sweeps) {
            auto times = runner.time(sweep, result_.base);
            SweepResult found{std::move(sweep), {}};
            for (size_t i = 0; i < times.size(); ++i) {
                found.rows.push_back(finish(found.sweep, i, std::move(times[i]), meter, progress));
            }
            result_.sweeps.push_back(std::move(found));
            result_.elapsed_s = Seconds(Clock::now() - start).count();
            result_.complete = result_.sweeps.size() == sweeps.size() && !stop_;
            save(result_);
        }
    }

  private:
    RowResult finish(const Sweep& sweep,
                     size_t index,
                     RowTimes times,
                     ErrorMeter& meter,
                     BenchProgress& progress) {
        const auto& row = sweep.rows[index];
        progress.at(sweep.name, "errors of " + row.series + ", " + row.label);
        RowResult result{std::move(times), {}, gbufferBytes(row.settings, needs_), {}};
        if (result.times.measured()) {
            result.errors = meter.measure(row);
            if (row.stream && !stop_) {
                const auto picture = meter.picture(row).value();
                result.stream = measureStream(picture->shown(), *row.stream, kEncodeCount).value();
            }
        }
        progress.done(BenchProgress::kErrorShare);
        return result;
    }

    const BenchOptions& options_;
    const std::atomic<bool>& stop_;
    scene::Scene scene_;
    render::SceneNeeds needs_;
    gpu::Device device_;
    render::Renderer renderer_;
    BenchResult result_;
};

// Told before anything is measured.
std::string readTemplate(const BenchOptions& options) {
    const auto root = findWebRoot(options.web_root);
    if (root.empty()) {
        throw StartupError({ErrorCode::kIo, "--report: no page found; ./deploy/build.sh makes it, "
                                            "--web-root names another"});
    }
    auto page = readText(root / "report.html").value();
    fillReport(page, nullptr).value();
    return page;
}

int listPresets(const BenchOptions& options) {
    const BenchBase base{options.settings, std::vector<BenchView>(1)};
    for (const auto name : benchPresetNames()) {
        const auto sweep = makeSweep(name, base);
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
        compareReports(readReport(options.compare[0]), readReport(options.compare[1])).value();
    std::fputs(toText(comparison).c_str(), stdout);
    return comparison.worse() ? 1 : 0;
}

void writeReport(const BenchOptions& options,
                 const std::string& page,
                 const nlohmann::ordered_json& report) {
    writeText(options.out, report.dump() + "\n");
    if (!options.report.empty()) {
        writeText(options.report, fillReport(page, report).value());
    }
}

int joinFiles(const BenchOptions& options, const std::string& page) {
    std::vector<nlohmann::ordered_json> reports;
    for (const auto& path : options.join) {
        reports.push_back(readReport(path));
    }
    writeReport(options, page, joinReports(reports).value());
    return 0;
}

void printSummary(const BenchResult& result) {
    size_t measured = 0;
    size_t skipped = 0;
    for (const auto& sweep : result.sweeps) {
        for (const auto& row : sweep.rows) {
            (row.times.measured() ? measured : skipped) += 1;
        }
    }
    fmt::print("{} rows measured, {} left out, {:.0f} s{}\n", measured, skipped, result.elapsed_s,
               result.complete ? "" : "; stopped before its end");
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
        page = readTemplate(options);
    }
    if (!options.join.empty()) {
        return joinFiles(options, page);
    }
    const StopFlag stop;
    BenchRun run(options, stop.stopped());
    const auto& names = options.presets;
    std::vector<Sweep> sweeps;
    for (const auto name : fullBenchPresetNames()) {
        if (names.empty()) {
            sweeps.push_back(makeSweep(name, run.result().base));
        }
    }
    for (const auto& name : names) {
        sweeps.push_back(makeSweep(name, run.result().base));
    }
    run.measure(std::move(sweeps), [&](const BenchResult& result) {
        writeReport(options, page, benchReport(result));
    });
    printSummary(run.result());
    const auto inexact = inexactRows(run.result());
    for (const auto& line : inexact) {
        fmt::print(stderr, "froxel: {}\n", line);
    }
    if (!inexact.empty()) {
        return 1;
    }
    return run.result().complete ? 0 : kStoppedExitCode;
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
