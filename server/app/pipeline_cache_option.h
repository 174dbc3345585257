// Where `froxel serve` and `froxel render` keep compiled pipelines.
#pragma once

#include "core/error.h"
#include "gpu/device_options.h"

#include <string>

namespace froxel::app {

// In $XDG_CACHE_HOME/froxel or ~/.cache/froxel; nowhere without either variable.
[[nodiscard]] gpu::PipelineCacheOptions defaultPipelineCache();

// A folder, or "off". Errors: kInvalidArgument.
[[nodiscard]] Result<gpu::PipelineCacheOptions> parsePipelineCache(const std::string& text);

} // namespace froxel::app
