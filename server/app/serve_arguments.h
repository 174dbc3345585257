// The options of `froxel serve` that are about the service: where it listens, whom it lets in, how
// much it takes.
#pragma once

#include "app/command_builder.h"
#include "app/serve_command.h"

#include <spdlog/fmt/fmt.h>

#include <string>

namespace froxel::app {

// `options` outlives the parse.
void addServeAddresses(CommandBuilder& command, ServeOptions& options);
void addServeLimits(CommandBuilder& command, ServeOptions& options);

// A default that may depend on the device's kind, in words.
template <class Text>
std::string byDevice(Text text) {
    const std::string cpu = text(session::defaultsFor(session::DeviceKind::kCpu));
    const std::string gpu = text(session::defaultsFor(session::DeviceKind::kGpu));
    return cpu == gpu ? cpu : fmt::format("{} on a CPU device, {} on a GPU", cpu, gpu);
}

} // namespace froxel::app
