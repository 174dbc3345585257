// The command line: every option, its unit, range and default.
#pragma once

#include "app/bench_command.h"
#include "app/info_command.h"
#include "app/load_command.h"
#include "app/render_command.h"
#include "app/scene_command.h"
#include "app/serve_command.h"

#include <array>
#include <string>
#include <string_view>
#include <variant>

namespace froxel::app {

// In spdlog's order, so that an index is a level.
inline constexpr std::array kLogLevelNames = {std::string_view("debug"), std::string_view("info"),
                                              std::string_view("warn"), std::string_view("error")};
enum class LogLevel : uint8_t { kDebug, kInfo, kWarn, kError };

// --help or --version was asked for: text for standard output, and nothing to run.
struct PrintText {
    std::string text;
};

struct Options {
    std::variant<PrintText,
                 ServeOptions,
                 RenderOptions,
                 BenchOptions,
                 LoadOptions,
                 InfoOptions,
                 SceneOptions>
        command;
    LogLevel log_level = LogLevel::kInfo;
};

// Pure. Throws StartupError(kInvalidArgument): one line that names the option, the value and what
// would be right.
[[nodiscard]] Options parseOptions(int argc, const char* const* argv);

} // namespace froxel::app
