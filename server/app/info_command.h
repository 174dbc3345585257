// `froxel info`: the device, and what a scene holds and needs; or what each scene of a folder is.
#pragma once

#include "bake/reader_process.h"
#include "gpu/device_options.h"

#include <filesystem>
#include <string>

namespace froxel::app {

struct InfoOptions {
    gpu::DeviceOptions device;
    std::string scene;                      // empty: the device only
    std::filesystem::path scenes;           // a folder of them, and nothing besides; empty: none
    std::filesystem::path environment_file; // empty: none is looked at
    bake::Sandbox sandbox = bake::Sandbox::kBest;
    bool json = false;
};

// Prints to standard output. With a scene it draws one frame with default settings, for what only a
// frame knows: the grid that is chosen, the plan in words, memory by purpose. Throws StartupError.
void runInfo(const InfoOptions& options);

} // namespace froxel::app
