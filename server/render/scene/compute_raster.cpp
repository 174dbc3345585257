#include "render/scene/compute_raster.h"

#include "embedded.h"
#include "interface/constants.h"
#include "render/scene/visibility_scene.h"

#include <algorithm>
#include <array>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

vk::raii::Pipeline makePipeline(const gpu::Device& device,
                                const VisibilityScene& scene,
                                gpu::Spirv code,
                                MaterialFlags material_flags,
                                const char* name) {
    return gpu::makeComputePipeline(device, code, scene.pipelines.constants({material_flags, 0, 0}),
                                    scene.pipelines.computeLayout(), name);
}

bool isMasked(const VisibilityGroup& group) {
    return (group.material_flags & io::kMaterialMask) != 0;
}

ComputeRaster::Pass makePass(const gpu::Device& device,
                             const VisibilityScene& scene,
                             gpu::Spirv code,
                             const char* name) {
    const auto& groups = scene.groups;
    ComputeRaster::Pass pass;
    if (!std::all_of(groups.begin(), groups.end(), isMasked)) {
        pass.opaque = makePipeline(device, scene, code, 0, name);
    }
    if (std::any_of(groups.begin(), groups.end(), isMasked)) {
        pass.masked = makePipeline(device, scene, code, scene.material_flags, name);
    }
    return pass;
}

} // namespace

std::string ComputeRaster::unusable(const gpu::Device& device, const VisibilityScene& scene) {
    if (!device.traits().int64_atomics) {
        return "the device lacks shaderBufferInt64Atomics";
    }
    if (scene.triangle_count > io::kRasterMostTriangles) {
        return "the scene has more than " + std::to_string(io::kRasterMostTriangles) + " triangles";
    }
    if (scene.placed.size() > device.limits().maxComputeWorkGroupCount[0]) {
        return "the scene has more meshlets than a dispatch may have workgroups";
    }
    return {};
}

ComputeRaster::ComputeRaster(const gpu::Device& device, const VisibilityScene& scene)
    : arena(device),
      cull_(makePipeline(device, scene, shaders::cull_list_comp(), 0, "cull (list)")),
      raster_meshlets_(makePass(device,
                                scene,
                                scene.pipelines.bindless()
                                    ? shaders::raster_meshlets_bindless_comp()
                                    : shaders::raster_meshlets_comp(),
                                "raster meshlets")),
      raster_blocks_(makePass(device,
                              scene,
                              scene.pipelines.bindless() ? shaders::raster_blocks_bindless_comp()
                                                         : shaders::raster_blocks_comp(),
                              "raster blocks")),
      unpack_(makePipeline(device, scene, shaders::raster_unpack_comp(), 0, "unpack ids")) {
    const auto scratch = [&](size_t bytes, vk::BufferUsageFlags usage, const char* name) {
        return arena.makeBuffer(bytes, usage | Usage::eStorageBuffer, gpu::MemoryUse::kDevice,
                                name);
    };
    counts = scratch(sizeof(io::RasterCounts), Usage::eIndirectBuffer | Usage::eTransferDst,
                     "raster counts");
    meshlets = scratch(scene.placed.size() * sizeof(uint32_t), {}, "visible meshlets");
    large =
        scratch(size_t{scene.triangle_count} * sizeof(io::LargeTriangle), {}, "large triangles");
    if (!scene.pipelines.bindless()) {
        for (const auto& group : scene.groups) {
            if (isMasked(group)) {
                masked_materials.push_back(group.material);
            }
        }
        std::sort(masked_materials.begin(), masked_materials.end());
        masked_materials.erase(std::unique(masked_materials.begin(), masked_materials.end()),
                               masked_materials.end());
    }
}

} // namespace froxel::render
