// `froxel info`: the device, and what a scene holds and needs.
#pragma once

#include "gpu/device_options.h"

#include <string>

namespace froxel::app {

struct InfoOptions {
    gpu::DeviceOptions device;
    std::string scene; // empty: the device only
    bool json = false;
};

// Prints to standard output. Throws StartupError.
void runInfo(const InfoOptions& options);

} // namespace froxel::app
