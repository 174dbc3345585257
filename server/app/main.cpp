// Parses, runs one subcommand, and turns whatever stopped it into one line and an exit code.
#include "app/log_setup.h"
#include "app/options.h"
#include "app/standard_streams.h"
#include "core/error.h"
#include "core/write_soon.h"
#include "net/stop_signal.h"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <string>
#include <unistd.h>
#include <variant>

namespace {

using namespace froxel;

// Also in options.cpp's help and in docs/guide/commands.md.
int exitCodeOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::kInvalidArgument:
        return 2;
    case ErrorCode::kScene:
        return 3;
    case ErrorCode::kDevice:
        return 4;
    case ErrorCode::kAddressInUse:
        return 5;
    case ErrorCode::kIo:
    case ErrorCode::kUnsupported:
    case ErrorCode::kCapacity:
    case ErrorCode::kTooLong:
    case ErrorCode::kCancelled:
        return 1;
    }
    return 1;
}

struct Run {
    int operator()(const app::PrintText& print) const {
        std::fputs(print.text.c_str(), stdout);
        return 0;
    }
    int operator()(const app::ServeOptions& options) const { return app::runServe(options); }
    int operator()(const app::RenderOptions& options) const { return app::runRender(options); }
    int operator()(const app::RecordOptions& options) const {
        app::runRecord(options);
        return 0;
    }
    int operator()(const app::BenchOptions& options) const { return app::runBench(options); }
    int operator()(const app::LoadOptions& options) const { return app::runLoad(options); }
    int operator()(const app::InfoOptions& options) const {
        app::runInfo(options);
        return 0;
    }
    int operator()(const app::DiffOptions& options) const { return app::runDiff(options); }
    int operator()(const app::ProbeOptions& options) const { return app::runProbe(options); }
    int operator()(const app::BakeOptions& options) const { return app::runBake(options); }
    int operator()(const app::SceneOptions& options) const {
        app::runScene(options);
        return 0;
    }
};

// Behind what was logged before it.
int fail(const std::string& message, int exit_code) {
    spdlog::default_logger()->flush();
    writeSoon(STDERR_FILENO, "froxel: " + message + "\n");
    return exit_code;
}

} // namespace

int main(int argc, char** argv) {
    // As the first process of a container it would lose a signal that came before its handler.
    net::holdStopSignals();
    app::holdStandardStreams();
    try {
        const auto options = app::parseOptions(argc, argv, app::readEnvironment(environ));
        if (const auto* bake = std::get_if<app::BakeOptions>(&options.command)) {
            return app::runBake(*bake); // which has no thread that logs
        }
        // Standard output is for results only: logs go to stderr.
        app::startLog(options.log_level, options.log_format);
        app::logConfiguration(options.configuration);
        if (!std::holds_alternative<app::ServeOptions>(options.command)) {
            net::letStopSignalsGo();
        }
        const int exit_code = std::visit(Run{}, options.command);
        app::finishResults();
        return exit_code;
    } catch (const StartupError& error) {
        return fail(error.what(), exitCodeOf(error.code()));
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
}
