// Triangle ids rastered in compute shaders instead of by the rasteriser: pipelines and buffers.
// Made when a frame first asks for it.
#pragma once

#include "gpu/memory.h"
#include "interface/raster_io.h"
#include "render/visibility_pipelines.h"

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

    // Of the textures that alpha tests read, those bound one at a time: empty where all are at once
    // or nothing is masked.
    std::vector<uint32_t> masked_materials;

    [[nodiscard]] vk::Pipeline cull() const { return *cull_; }
    [[nodiscard]] vk::Pipeline rasterMeshlets() const { return *raster_meshlets_; }
    [[nodiscard]] vk::Pipeline rasterBlocks() const { return *raster_blocks_; }
    [[nodiscard]] vk::Pipeline unpack() const { return *unpack_; }

  private:
    vk::raii::Pipeline cull_;
    vk::raii::Pipeline raster_meshlets_;
    vk::raii::Pipeline raster_blocks_;
    vk::raii::Pipeline unpack_;
};

} // namespace froxel::render
