#include "render/device/build_hash.h"

#include "embedded.h"
#include "gpu/pipeline_cache.h"

#include <span>

namespace froxel::render {

uint64_t hashOfShaders() {
    uint64_t hash = gpu::hashBytes({});
    for (const auto& words : shaders::all()) {
        hash = gpu::hashBytes(std::as_bytes(words), hash);
    }
    return hash;
}

} // namespace froxel::render
