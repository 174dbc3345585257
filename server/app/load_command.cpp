#include "app/load_command.h"

#include "app/camera_path_option.h"
#include "app/exit_codes.h"
#include "app/load_arguments.h"
#include "app/load_capacity.h"
#include "app/load_early_stop.h"
#include "app/load_report.h"
#include "app/load_series.h"
#include "app/load_verdict.h"
#include "app/output_file.h"
#include "app/report_page.h"
#include "bench/html.h"
#include "core/text.h"
#include "load/capacity.h"
#include "load/client_tls.h"
#include "load/hdr_log.h"
#include "load/load_run.h"
#include "load/requirement.h"
#include "load/scene_script.h"
#include "load/script_file.h"
#include "net/stop_signal.h"
#include "net/token_file.h"
#include "session/proto_enums.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stop_token>
#include <thread>
#include <unistd.h>

namespace froxel::app {
namespace {

constexpr int kStoppedExitCode = 130; // as a shell has it for SIGINT
// Few enough that handlers seldom wait for one another: 200 viewers with 60 commands and some
// frames a second each take a third of a core.
constexpr uint32_t kViewersPerThread = 32;
constexpr uint32_t kMostTried = 10'000; // viewers, by --find

std::vector<std::string> tokensOf(const LoadOptions& options) {
    std::vector<std::string> tokens;
    if (!options.token_file.empty()) {
        for (net::TokenLine& line : net::readTokenFile(options.token_file).value()) {
            tokens.push_back(std::move(line.token));
        }
    }
    return tokens;
}

load::ScriptChoice scriptOf(const LoadOptions& options, const std::string& name) {
    if (name == "scenes") {
        const auto tokens = tokensOf(options);
        const std::string token = tokens.empty() ? "" : tokens.front();
        return load::Scenes{load::fetchSceneIds(options.target, token).value()};
    }
    if (name == "orbit") {
        return load::Orbit{};
    }
    if (name == "idle") {
        return load::Idle{};
    }
    if (name == "storm") {
        return load::Storm{};
    }
    if (isPathFile(name)) {
        return std::make_shared<const path::CameraPath>(readPathFile(name).value());
    }
    return load::readScriptFile(name).value();
}

std::vector<load::ScriptShare> scriptsOf(const LoadOptions& options) {
    if (options.scripts.empty()) {
        return {{"orbit", load::Orbit{}, 1}};
    }
    std::vector<load::ScriptShare> scripts;
    for (const std::string& text : options.scripts) {
        const ScriptName script = scriptNameOf(text);
        scripts.push_back({std::filesystem::path(script.name).filename().string(),
                           scriptOf(options, script.name), script.share});
    }
    return scripts;
}

load::ViewerOptions viewerOptions(const LoadOptions& options) {
    load::ViewerOptions viewer;
    viewer.target = options.target;
    viewer.think = options.think;
    if (options.size) {
        viewer.size.emplace();
        viewer.size->set_width(options.size->width_px);
        viewer.size->set_height(options.size->height_px);
    }
    viewer.light_count = options.light_count;
    if (options.codec != settings::kPlainCodec || options.video_kbps) {
        v1::SetEncoding& encoding = viewer.encoding.emplace();
        encoding.set_codec(session::toProto<v1::Codec>(settings::kCodecNames, options.codec));
        if (options.video_kbps) {
            encoding.set_video_kbps(*options.video_kbps);
        }
    }
    viewer.room = options.room;
    viewer.depth = options.depth;
    viewer.tokens = tokensOf(options);
    if (!options.tls_authorities.empty() && !options.target.tls) {
        throw StartupError({ErrorCode::kInvalidArgument, "--tls-authorities is for wss://, and " +
                                                             printable(options.url, 200) +
                                                             " is without TLS"});
    }
    if (options.target.tls) {
        viewer.tls = load::clientTls(options.tls_authorities).value();
    }
    return viewer;
}

uint32_t threadsFor(const LoadOptions& options, uint32_t viewer_count) {
    const uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
    return options.thread_count.value_or(std::clamp(viewer_count / kViewersPerThread, 1U, cores));
}

void setViewers(load::RunOptions& run, const LoadOptions& options, uint32_t viewer_count) {
    run.visits = load::visitsOver(Seconds(options.ramp_s), viewer_count);
    run.thread_count = threadsFor(options, viewer_count);
}

load::RunOptions runOptions(const LoadOptions& options) {
    load::RunOptions run;
    run.viewer = viewerOptions(options);
    run.scripts = scriptsOf(options);
    if (options.stages.empty()) {
        run.seconds = Seconds(options.seconds);
        setViewers(run, options, options.viewer_count.value_or(1));
    } else {
        run.measures_together = false;
        run.seconds = load::lengthOf(options.stages);
        run.visits = load::visitsOf(options.stages);
        run.thread_count = threadsFor(options, load::mostViewersOf(options.stages));
    }
    return run;
}

std::vector<load::Requirement> requirementsOf(const std::vector<std::string>& texts) {
    std::vector<load::Requirement> all;
    for (const std::string& text : texts) {
        const auto requirements = load::parseRequirements(text).value();
        all.insert(all.end(), requirements.begin(), requirements.end());
    }
    return all;
}

// One line on stderr, written over each second; nothing where that is no terminal.
class ProgressLine {
  public:
    ProgressLine() : shown_(isatty(STDERR_FILENO) != 0) {}
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const std::string& text) const {
        if (shown_) {
            fmt::print(stderr, "\r\x1b[K{}", text);
            std::fflush(stderr);
        }
    }
    void clear() const {
        if (shown_) {
            std::fputs("\r\x1b[K", stderr);
        }
    }

  private:
    const bool shown_;
};

// A stop that the first SIGINT or SIGTERM requests. A second one ends the process.
class SignalledStop {
  public:
    SignalledStop()
        : waiter_([this] {
              if (signal_.wait() != 0) {
                  stop_.request_stop();
              }
          }) {}
    ~SignalledStop() { signal_.request(); }
    SignalledStop(const SignalledStop&) = delete;
    SignalledStop& operator=(const SignalledStop&) = delete;
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  private:
    net::StopSignal signal_;
    std::stop_source stop_;
    std::jthread waiter_; // last: joins before the others go
};

// What a run leaves behind besides its result.
struct Watched {
    load::RunResult result;
    std::vector<SeriesRow> series;
};

Watched watchRun(const LoadOptions& options,
                 const load::RunOptions& run,
                 const std::vector<load::Requirement>& requirements) {
    std::optional<SeriesFile> file;
    if (!options.series.empty()) {
        file.emplace(options.series);
    }
    std::optional<LoadEarlyStop> early_stop;
    if (options.stop_early_s) {
        early_stop.emplace(requirements, Seconds(*options.stop_early_s));
    }
    Watched watched;
    std::optional<StartupError> failure; // viewers are under way: not thrown past them
    const SignalledStop stop;
    const ProgressLine line;
    watched.result = load::runLoad(run, stop.token(), [&](const load::RunSecond& second) {
        const SeriesRow row = seriesRowOf(second);
        line.show(loadProgress(run, second, row));
        watched.series.push_back(row);
        try {
            if (file) {
                file->add(row);
            }
        } catch (const StartupError& error) {
            failure = error;
            return false;
        }
        return !early_stop || early_stop->goesOn(second);
    });
    if (failure) {
        throw StartupError(*failure);
    }
    return watched;
}

// All times of the run, each as one interval.
std::string histogramsOf(const load::RunResult& result) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const Seconds length(result.seconds);
    std::string log = load::hdrLogHeader((Seconds(now) - length).count());
    const load::Samples samples = load::pool(result).measured.samples;
    for (const load::SampleSeries& series : load::kSampleSeries) {
        log += load::hdrLogLine(series.name, Seconds(0), length, samples.*series.samples);
    }
    return log;
}

void requireFolders(const LoadOptions& options) {
    for (const auto& file :
         {options.json, options.series, options.junit, options.histograms, options.report}) {
        if (!file.empty() && file != "-") {
            requireFolderOf(file);
        }
    }
}

int runPlain(const LoadOptions& options) {
    const auto requirements = requirementsOf(options.requirements);
    const std::string page =
        options.report.empty() ? "" : readReportPage(options.web_root, "load.html");
    const load::RunOptions run = runOptions(options);
    const Watched watched = watchRun(options, run, requirements);
    const LoadVerdict verdict = loadVerdict(requirements, watched.result);
    const auto report = loadReport(options, run, watched.result, verdict, watched.series);
    printResults(options.json, loadTable(watched.result, verdict), report);
    if (!options.report.empty()) {
        writeText(options.report, bench::fillReport(page, report).value());
    }
    if (!options.histograms.empty()) {
        writeText(options.histograms, histogramsOf(watched.result));
    }
    if (!options.junit.empty()) {
        writeText(options.junit, junitOf("froxel load", casesOf(verdict), watched.result.seconds));
    }
    const auto broken = brokenLine(verdict);
    if (verdict.failure) {
        throw StartupError({ErrorCode::kIo, *broken});
    }
    if (broken) {
        fmt::print(stderr, "froxel: {}\n", *broken);
        return kExitRequirement;
    }
    if (watched.result.ended_early) { // what was broken so long has been mended since
        fmt::print(stderr, "froxel: a requirement was broken for {:g} s\n", *options.stop_early_s);
        return kExitRequirement;
    }
    return watched.result.stopped ? kStoppedExitCode : EXIT_SUCCESS;
}

// One more viewer than the server has a place for is an answer, so the trial need not go on.
bool nobodyFailed(const load::RunSecond& second) {
    return std::none_of(
        second.changes.begin(), second.changes.end(),
        [](const load::ViewerChange& change) { return change.failure.has_value(); });
}

int runFind(const LoadOptions& options) {
    const auto requirements = requirementsOf(options.find_requirements);
    load::CapacitySearch search(options.viewer_count.value_or(kMostTried), options.trial_count);
    load::RunOptions run = runOptions(options);
    std::vector<LoadTrial> trials;
    bool stopped = false;
    {
        const SignalledStop stop;
        const ProgressLine line;
        while (const auto viewers = stopped ? std::nullopt : search.next()) {
            setViewers(run, options, *viewers);
            auto result = load::runLoad(run, stop.token(), [&](const load::RunSecond& second) {
                line.show(fmt::format("trial {} with {} viewers: {}", trials.size() + 1, *viewers,
                                      loadProgress(run, second, seriesRowOf(second))));
                return nobodyFailed(second);
            });
            stopped = result.stopped;
            if (!stopped) {
                const LoadVerdict verdict = loadVerdict(requirements, result);
                search.note(*viewers, verdict.held());
                line.clear();
                trials.push_back(trialOf(*viewers, result, verdict));
                std::fputs(trialLine(trials.back()).c_str(), stderr);
            }
        }
    }
    printResults(options.json, capacityText(search, trials, stopped),
                 capacityReport(options, run, search, trials, stopped));
    if (stopped) {
        return kStoppedExitCode;
    }
    if (search.held() == 0) {
        throw StartupError({ErrorCode::kIo, "not even one viewer is served as required: " +
                                                trials.back().broken.value_or("")});
    }
    return EXIT_SUCCESS;
}

} // namespace

int runLoad(const LoadOptions& options) {
    requireFolders(options);
    return options.find_requirements.empty() ? runPlain(options) : runFind(options);
}

} // namespace froxel::app
