// Options for what is done to the lit picture.
#pragma once

#include "app/command_builder.h"
#include "view/settings.h"

namespace froxel::app {

// Of pictures alone.
void addToneMap(CommandBuilder& command, view::ViewSettings& settings);

// What both pictures and first views take: bloom, antialiasing, fog, shadows, outlines.
void addPost(CommandBuilder& command, view::ViewSettings& settings);

} // namespace froxel::app
