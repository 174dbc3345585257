#include "render/pipelines/texture_limit.h"

#include "core/error.h"
#include "interface/material_slots.h"

#include <string>

namespace froxel::render {

uint32_t materialSlots(const gpu::DeviceTraits& traits) {
    for (const uint32_t slots : {io::kMaterialSlots, io::kSurfaceSlots}) {
        if (traits.most_textures >= kPassTextures + slots &&
            traits.most_samplers >= slots + kPassSamplers) {
            return slots;
        }
    }
    throw StartupError(
        {ErrorCode::kUnsupported,
         "surfaces are drawn from " + std::to_string(kPassTextures + io::kSurfaceSlots) +
             " sampled descriptors in a shader, " + std::to_string(io::kSurfaceSlots) +
             " of them with samplers; this device allows " + std::to_string(traits.most_textures) +
             " and " + std::to_string(traits.most_samplers)});
}

} // namespace froxel::render
