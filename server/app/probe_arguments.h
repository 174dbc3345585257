// The options of `froxel probe`.
#pragma once

#include "app/command_builder.h"
#include "app/probe_command.h"

namespace froxel::app {

// `options` outlives the parse.
inline void addProbeArguments(CommandBuilder& command, ProbeOptions& options) {
    constexpr settings::Range<double> kTimeoutRange{"timeout", 0.01, 3600.0};
    command.text("URL", "", options.url, options.url,
                 "URL at its admin address: /livez, /readyz or /startupz");
    command.number("--timeout", options.timeout_s, kTimeoutRange, "Longest wait in seconds");
}

} // namespace froxel::app
