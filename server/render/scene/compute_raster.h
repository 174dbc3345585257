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
    // most_triangles: of a batch, about; of a meshlet at least.
    ComputeRaster(const gpu::Device& device, const VisibilityScene& scene, uint32_t most_triangles);

    // Empty when the device can raster the scene so, else why not.
    [[nodiscard]] static std::string unusable(const gpu::Device& device,
                                              const VisibilityScene& scene);

    gpu::MemoryArena arena;
    gpu::Buffer batches;    // io::RasterBatch
    gpu::Buffer meshlets;   // visible ones
    gpu::Buffer large;      // io::LargeTriangle, room for every triangle of a batch
    gpu::Buffer far_depths; // of blocks of the largest picture; none where there is one batch
    // As each frame begins them.
    const std::vector<io::RasterBatch> empty_batches;

    const bool many_meshlets;         // more than a device draws at a time
    const bool opaque;                // there are opaque materials
    const MaterialFlags masked_flags; // of masked ones; 0: there are none
    // Whose textures alpha tests read, where materials are bound one at a time.
    std::vector<uint32_t> masked_materials;
};

} // namespace froxel::render
