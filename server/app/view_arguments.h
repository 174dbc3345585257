// Options of what is drawn, for the subcommands that draw.
#pragma once

#include "app/command_builder.h"
#include "view/settings.h"

#include <filesystem>

namespace froxel::app {

// Where and how lights are added up, and what is shown instead.
void addShading(CommandBuilder& command, view::ViewSettings& settings);
// Lights but for count and radius; no_animate: what that flag does.
void addLightDetails(CommandBuilder& command, view::Lights& lights, const char* no_animate);
// Lights with places of their own; `file` becomes the one they were read from.
void addLightSet(CommandBuilder& command, view::PlacedLights& placed, std::filesystem::path& file);
// All of it, for pictures.
void addLights(CommandBuilder& command, view::Lights& lights, std::filesystem::path& light_set);

} // namespace froxel::app
