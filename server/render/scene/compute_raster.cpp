#include "render/scene/compute_raster.h"

#include "interface/constants.h"
#include "render/scene/visibility_scene.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

bool isMasked(const VisibilityGroup& group) {
    return (group.material_flags & io::kMaterialMask) != 0;
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
    : arena(device), opaque(!std::ranges::all_of(scene.groups, isMasked)),
      masked_flags(std::ranges::any_of(scene.groups, isMasked) ? scene.material_flags : 0) {
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
