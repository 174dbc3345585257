// The options of `froxel diff`.
#pragma once

#include "app/command_builder.h"
#include "app/diff_command.h"

namespace froxel::app {

// `options` outlives the parse.
void addDiffArguments(CommandBuilder& command, DiffOptions& options);

} // namespace froxel::app
