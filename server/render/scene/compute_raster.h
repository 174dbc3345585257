// Triangle ids rastered in compute shaders instead of by the rasteriser: its buffers.
// Made when a frame first asks for it.
#pragma once

#include "gpu/memory.h"
#include "interface/raster_io.h"
#include "render/device/visibility_pipelines.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace froxel::render {

class VisibilityScene;

class ComputeRaster {
  public:
    ComputeRaster(const gpu::Device& device, const VisibilityScene& scene);

    // Empty when the device can raster the scene so, else why not.
    [[nodiscard]] static std::string unusable(const gpu::Device& device,
                                              const VisibilityScene& scene);

    gpu::MemoryArena arena;
    gpu::Buffer counts;   // io::RasterCounts
    gpu::Buffer meshlets; // visible ones
    gpu::Buffer large;    // io::LargeTriangle, room for every triangle

    const bool opaque;                // there are opaque materials
    const MaterialFlags masked_flags; // of masked ones; 0: there are none
    // Whose textures alpha tests read, where materials are bound one at a time.
    std::vector<uint32_t> masked_materials;
};

} // namespace froxel::render
