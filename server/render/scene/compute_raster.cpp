#include "render/scene/compute_raster.h"

#include "core/ceil_divide.h"
#include "interface/constants.h"
#include "render/scene/visibility_scene.h"
#include "settings/ranges.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

bool isMasked(const VisibilityGroup& group) {
    return (group.material_flags & io::kMaterialMask) != 0;
}

// A GPU of 132 multiprocessors runs some thousands of workgroups at a time.
constexpr size_t kManyMeshlets = 16'384;

// Of a batch, all of whose triangles may be large.
uint32_t
meshletsOfBatch(const gpu::Device& device, const VisibilityScene& scene, uint32_t most_triangles) {
    const auto all = static_cast<uint32_t>(scene.placed.size());
    const uint32_t most =
        scene.triangle_count <= most_triangles ? all : most_triangles >> io::kTriangleBits;
    return std::clamp(most, 1U, device.limits().maxComputeWorkGroupCount[0]);
}

size_t batchesOf(const VisibilityScene& scene, uint32_t meshlet_count) {
    return std::max<size_t>(ceilDivide(scene.placed.size(), size_t{meshlet_count}), 1);
}

std::vector<io::RasterBatch> emptyBatches(const VisibilityScene& scene, uint32_t meshlet_count) {
    std::vector<io::RasterBatch> batches(batchesOf(scene, meshlet_count));
    for (uint32_t i = 0; i < batches.size(); ++i) {
        batches[i] = {.listed = {0, 1, 1},
                      .drawn = {0, 1, 1},
                      .others = {0, 1, 1},
                      .most = meshlet_count,
                      .large = 0,
                      .first = i * meshlet_count,
                      .first_drawn = (i > 0 ? i - 1 : 0) * meshlet_count,
                      .listed_of_all = 0,
                      .layer_count = 0};
    }
    return batches;
}

} // namespace

std::string ComputeRaster::unusable(const gpu::Device& device, const VisibilityScene& scene) {
    if (!device.traits().int64_atomics) {
        return "the device lacks shaderBufferInt64Atomics";
    }
    const uint32_t each = meshletsOfBatch(device, scene, io::kRasterMostTriangles);
    if (scene.surfaces == Surfaces::kTransmissive &&
        device.limits().maxComputeWorkGroupInvocations < io::kPeeledGroup) {
        return "the device runs fewer than " + std::to_string(io::kPeeledGroup) +
               " invocations in a workgroup";
    }
    // What a batch hides of later ones is not known where several layers are kept.
    const size_t most = scene.surfaces == Surfaces::kSolid ? io::kRasterMostBatches : 1;
    if (batchesOf(scene, each) > most) {
        return "the scene has more meshlets than " + std::to_string(most) + " batches may have";
    }
    return {};
}

ComputeRaster::ComputeRaster(const gpu::Device& device,
                             const VisibilityScene& scene,
                             uint32_t most_triangles)
    : arena(device),
      empty_batches(emptyBatches(scene, meshletsOfBatch(device, scene, most_triangles))),
      many_meshlets(empty_batches.size() > 1 || scene.placed.size() > kManyMeshlets),
      opaque(!std::ranges::all_of(scene.groups, isMasked)),
      masked_flags(std::ranges::any_of(scene.groups, isMasked) ? scene.material_flags : 0) {
    const auto scratch = [&](size_t bytes, vk::BufferUsageFlags usage, const char* name) {
        return arena.makeBuffer(bytes, usage | Usage::eStorageBuffer, gpu::MemoryUse::kDevice,
                                name);
    };
    batches = scratch(empty_batches.size() * sizeof(io::RasterBatch),
                      Usage::eIndirectBuffer | Usage::eTransferDst, "raster batches");
    meshlets = scratch(scene.placed.size() * sizeof(uint32_t), {}, "visible meshlets");
    const size_t most_of_batch = size_t{empty_batches.front().most} << io::kTriangleBits;
    large =
        scratch(std::min<size_t>(scene.triangle_count, most_of_batch) * sizeof(io::LargeTriangle),
                {}, "large triangles");
    if (empty_batches.size() > 1) {
        const auto blocks = [](size_t side) {
            return ceilDivide(size_t{settings::kWidthRange.max}, side) *
                   ceilDivide(size_t{settings::kHeightRange.max}, side);
        };
        far_depths = scratch((blocks(io::kFarFine) + blocks(io::kFarCoarse)) * sizeof(float), {},
                             "farthest depths");
    }
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
