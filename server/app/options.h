// The command line: every option, its unit, range and default.
#pragma once

#include "app/bake_command.h"
#include "app/bench_command.h"
#include "app/configuration.h"
#include "app/diff_command.h"
#include "app/info_command.h"
#include "app/load_command.h"
#include "app/log_setup.h"
#include "app/probe_command.h"
#include "app/record_command.h"
#include "app/render_command.h"
#include "app/scene_command.h"
#include "app/serve_command.h"

#include <string>
#include <variant>

namespace froxel::app {

// --help or --version was asked for: text for standard output, and nothing to run.
struct PrintText {
    std::string text;
};

struct Options {
    std::variant<PrintText,
                 ServeOptions,
                 RenderOptions,
                 RecordOptions,
                 BenchOptions,
                 LoadOptions,
                 InfoOptions,
                 DiffOptions,
                 SceneOptions,
                 ProbeOptions,
                 BakeOptions>
        command;
    LogLevel log_level = LogLevel::kInfo;
    LogFormat log_format = LogFormat::kText;
    Configuration configuration{}; // of serve
};

// Of serve also from `environment` and the file of --config, which alone is read. Throws
// StartupError(kInvalidArgument): one line that names the option, the value and what would be
// right.
[[nodiscard]] Options
parseOptions(int argc, const char* const* argv, const Environment& environment = {});

} // namespace froxel::app
