#include "app/load_command.h"

#include "app/load_report.h"
#include "app/load_verdict.h"
#include "app/output_file.h"
#include "core/text.h"
#include "load/client_tls.h"
#include "load/load_run.h"
#include "load/scene_script.h"
#include "load/script_file.h"
#include "net/stop_signal.h"
#include "net/token_file.h"
#include "session/proto_enums.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stop_token>
#include <thread>
#include <unistd.h>

namespace froxel::app {
namespace {

constexpr int kStoppedExitCode = 130; // as a shell has it for SIGINT
// Few enough that handlers seldom wait for one another: 200 viewers with 60 commands and some
// frames a second each take a third of a core.
constexpr uint32_t kViewersPerThread = 32;

load::ScriptChoice scriptOf(const LoadOptions& options) {
    const std::string& text = options.script;
    if (text == "scenes") {
        const auto tokens = options.token_file.empty()
                                ? std::vector<std::string>{""}
                                : net::readTokenFile(options.token_file).value();
        return load::Scenes{load::fetchSceneIds(options.target, tokens.front()).value()};
    }
    if (text == "orbit") {
        return load::Orbit{};
    }
    if (text == "idle") {
        return load::Idle{};
    }
    if (text == "storm") {
        return load::Storm{};
    }
    return load::readScriptFile(text).value();
}

load::RunOptions runOptions(const LoadOptions& options) {
    load::RunOptions run;
    run.viewer.target = options.target;
    run.viewer.script = scriptOf(options);
    if (options.size) {
        run.viewer.size.emplace();
        run.viewer.size->set_width(options.size->width_px);
        run.viewer.size->set_height(options.size->height_px);
    }
    run.viewer.light_count = options.light_count;
    if (options.codec != settings::kPlainCodec || options.video_kbps) {
        v1::SetEncoding& encoding = run.viewer.encoding.emplace();
        encoding.set_codec(session::toProto<v1::Codec>(settings::kCodecNames, options.codec));
        if (options.video_kbps) {
            encoding.set_video_kbps(*options.video_kbps);
        }
    }
    run.viewer.room = options.room;
    if (!options.token_file.empty()) {
        run.viewer.tokens = net::readTokenFile(options.token_file).value();
    }
    if (!options.tls_authorities.empty() && !options.target.tls) {
        throw StartupError({ErrorCode::kInvalidArgument, "--tls-authorities is for wss://, and " +
                                                             printable(options.url, 200) +
                                                             " is without TLS"});
    }
    if (options.target.tls) {
        run.viewer.tls = load::clientTls(options.tls_authorities).value();
    }
    run.viewer_count = options.viewer_count;
    run.ramp = Seconds(options.ramp_s);
    run.seconds = Seconds(options.seconds);
    const uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
    run.thread_count = std::clamp(options.viewer_count / kViewersPerThread, 1U, cores);
    return run;
}

// One line on stderr, written over each second; nothing where that is no terminal.
class ProgressLine {
  public:
    explicit ProgressLine(const LoadOptions& options)
        : shown_(isatty(STDERR_FILENO) != 0), options_(options) {}
    ~ProgressLine() {
        if (shown_) {
            std::fputs("\r\x1b[K", stderr);
        }
    }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const load::RunProgress& progress) {
        if (shown_) {
            fmt::print(stderr, "\r\x1b[K{}", loadProgress(options_, progress, before_));
            std::fflush(stderr);
        }
        before_ = progress;
    }

  private:
    const bool shown_;
    const LoadOptions& options_;
    load::RunProgress before_;
};

load::RunResult runUntilSignal(const LoadOptions& options, const load::RunOptions& run) {
    net::StopSignal signal;
    std::stop_source stop;
    std::jthread waiter([&] {
        if (signal.wait() != 0) {
            stop.request_stop();
        }
    });
    ProgressLine line(options);
    auto result = load::runLoad(run, stop.get_token(),
                                [&line](const load::RunProgress& now) { line.show(now); });
    signal.request();
    return result;
}

} // namespace

int runLoad(const LoadOptions& options) {
    const load::RunOptions run = runOptions(options);
    const bool to_stdout = options.json == "-";
    if (!options.json.empty() && !to_stdout) {
        requireFolderOf(options.json);
    }
    const load::RunResult result = runUntilSignal(options, run);
    const auto broken = loadVerdict(options, result);
    const std::string table = loadTable(result);
    std::fputs(table.c_str(), to_stdout ? stderr : stdout);
    std::fflush(stdout);
    if (!options.json.empty()) {
        const std::string report = loadReport(options, result).dump(2) + "\n";
        if (to_stdout) {
            std::fputs(report.c_str(), stdout);
        } else {
            writeText(options.json, report);
        }
    }
    if (broken) {
        throw StartupError({ErrorCode::kIo, *broken});
    }
    return result.stopped ? kStoppedExitCode : EXIT_SUCCESS;
}

} // namespace froxel::app
