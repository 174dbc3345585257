// The options of `froxel load`.
#pragma once

#include "app/command_builder.h"
#include "app/load_command.h"

#include <cstdint>
#include <string>

namespace froxel::app {

// Of --script: what stands before ":SHARE", and the share; without one it is 1.
struct ScriptName {
    std::string name;
    uint32_t share = 1;
};
[[nodiscard]] ScriptName scriptNameOf(const std::string& text);
// Whether a script of that name is a camera path.
[[nodiscard]] bool isPathFile(const std::string& name);

// `options` outlives the parse.
void addLoadArguments(CommandBuilder& command, LoadOptions& options);

} // namespace froxel::app
