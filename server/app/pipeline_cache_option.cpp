#include "app/pipeline_cache_option.h"

#include "embedded.h"
#include "gpu/pipeline_cache.h"

#include <span>

namespace froxel::app {

namespace {

uint64_t hashOfShaders() {
    uint64_t hash = gpu::hashBytes({});
    for (const auto& words : shaders::all()) {
        hash = gpu::hashBytes(std::as_bytes(words), hash);
    }
    return hash;
}

} // namespace

gpu::PipelineCacheOptions defaultPipelineCache() {
    return {.folder = gpu::defaultPipelineCacheFolder(), .build = hashOfShaders()};
}

Result<gpu::PipelineCacheOptions> parsePipelineCache(const std::string& text) {
    if (text.empty()) {
        return Error{ErrorCode::kInvalidArgument, "'' is neither a folder nor off"};
    }
    if (text == "off") {
        return gpu::PipelineCacheOptions{};
    }
    return gpu::PipelineCacheOptions{.folder = text, .build = hashOfShaders()};
}

} // namespace froxel::app
