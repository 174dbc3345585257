// Where a subcommand's options come from besides the command line: variables FROXEL_NAME of the
// environment, and a TOML file. One rule of precedence: command line, environment, file, default.
#pragma once

#include "app/command_builder.h"
#include "app/configuration.h"

#include <string>
#include <string_view>

namespace froxel::app {

// "FROXEL_MAX_SESSIONS" of "max-sessions".
[[nodiscard]] std::string variableName(std::string_view option);

// Gives the options of `command` that its command line left out what environment and file say; the
// file is the value of its option --config. Called when the command line is parsed. Throws
// CLI::ValidationError: a value that the option refuses, a key that names no option, an unreadable
// file; the message names variable or file.
[[nodiscard]] Configuration applySources(const CommandBuilder& command,
                                         const Environment& environment);

} // namespace froxel::app
