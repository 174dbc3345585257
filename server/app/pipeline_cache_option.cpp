#include "app/pipeline_cache_option.h"

#include "gpu/pipeline_cache.h"
#include "render/device/build_hash.h"

namespace froxel::app {

gpu::PipelineCacheOptions defaultPipelineCache() {
    return {.folder = gpu::defaultPipelineCacheFolder(), .build = render::hashOfShaders()};
}

Result<gpu::PipelineCacheOptions> parsePipelineCache(const std::string& text) {
    if (text.empty()) {
        return Error{ErrorCode::kInvalidArgument, "'' is neither a folder nor off"};
    }
    if (text == "off") {
        return gpu::PipelineCacheOptions{};
    }
    return gpu::PipelineCacheOptions{.folder = text, .build = render::hashOfShaders()};
}

} // namespace froxel::app
