// The options of `froxel load`.
#pragma once

#include "app/command_builder.h"
#include "app/load_command.h"

namespace froxel::app {

// `options` outlives the parse.
void addLoadArguments(CommandBuilder& command, LoadOptions& options);

} // namespace froxel::app
