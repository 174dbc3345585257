// Settings back to the `froxel render` command line that draws them. Pure.
#pragma once

#include "app/render_command.h"

#include <string>
#include <vector>

namespace froxel::app {

// What `froxel` takes to draw as `options` say: "render", then options that are not at their
// default, but scene, device, renderer, lights, size and frames always. `camera` is the text for
// --camera, empty for the scene's first; options.camera, grid_camera, pipeline cache and validation
// are ignored. Parsing them gives the same settings; toon ramps, which have no option, must be at
// their defaults (FROXEL_ASSERT).
[[nodiscard]] std::vector<std::string> renderArguments(const RenderOptions& options,
                                                       const std::string& camera);

// One line for a POSIX shell: "froxel" and the arguments, quoted where needed.
[[nodiscard]] std::string shellCommand(const std::vector<std::string>& arguments);

} // namespace froxel::app
