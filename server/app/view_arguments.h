// Options of what is drawn, for the subcommands that draw.
#pragma once

#include "app/command_builder.h"
#include "view/settings.h"

namespace froxel::app {

// Where and how lights are added up, and what is shown instead.
void addShading(CommandBuilder& command, view::ViewSettings& settings);
// Lights but for count and radius; no_animate: what that flag does.
void addLightDetails(CommandBuilder& command, view::Lights& lights, const char* no_animate);
// All of it, for pictures.
void addLights(CommandBuilder& command, view::Lights& lights);

} // namespace froxel::app
