// Triangle ids rastered in compute shaders instead of by the rasteriser: pipelines and buffers.
// Made when a frame first asks for it.
#pragma once

#include "gpu/memory.h"
#include "interface/raster_io.h"
#include "render/scene/visibility_pipelines.h"

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

    // Whose textures alpha tests read, where materials are bound one at a time.
    std::vector<uint32_t> masked_materials;

    [[nodiscard]] vk::Pipeline cull() const { return *cull_; }
    // Of opaque materials, and of masked ones: null where there is none.
    struct Pass {
        vk::raii::Pipeline opaque{nullptr};
        vk::raii::Pipeline masked{nullptr};
    };
    [[nodiscard]] const Pass& rasterMeshlets() const { return raster_meshlets_; }
    [[nodiscard]] const Pass& rasterBlocks() const { return raster_blocks_; }
    [[nodiscard]] vk::Pipeline unpack() const { return *unpack_; }

  private:
    vk::raii::Pipeline cull_;
    Pass raster_meshlets_;
    Pass raster_blocks_;
    vk::raii::Pipeline unpack_;
};

} // namespace froxel::render
