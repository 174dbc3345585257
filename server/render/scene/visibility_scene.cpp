#include "render/scene/visibility_scene.h"

#include "core/assert.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "render/pipelines/texture_limit.h"
#include "render/scene/scene_resources.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>
#include <utility>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr size_t kMostMeshlets = size_t{1} << (32 - io::kTriangleBits);

// The flags that tell the raster pass's pipelines apart: all of a masked material's, else its
// faces.
MaterialFlags rasterFlags(const DrawItem& item) {
    const bool masked = (item.material_flags & io::kMaterialMask) != 0;
    return masked ? item.material_flags : item.material_flags & io::kMaterialDoubleSided;
}

// Items of one group have equal keys; opaque ones come first, they need no shading.
auto groupKey(const DrawItem& item) {
    const bool masked = (item.material_flags & io::kMaterialMask) != 0;
    return std::tuple(masked, masked ? item.primitive.material : 0U, rasterFlags(item),
                      item.mirrored);
}

// Placed meshlets in the order of their draws, groups filled up to whole workgroups.
class Placer {
  public:
    Placer(const SceneResources& scene,
           std::span<const DrawItem> drawn,
           Surfaces surfaces,
           Detail detail)
        : scene_(scene), with_levels_(detail == Detail::kLevels) {
        std::vector<uint32_t> order;
        for (uint32_t i = 0; i < drawn.size(); ++i) {
            if (isOf(surfaces, drawn[i].material_flags)) {
                order.push_back(i);
            }
        }
        std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return groupKey(drawn[a]) < groupKey(drawn[b]);
        });
        const DrawItem* last = nullptr;
        for (const uint32_t i : order) {
            const DrawItem& item = drawn[i];
            if (last == nullptr || groupKey(*last) != groupKey(item)) {
                closeGroup();
                groups.push_back({item.primitive.material, rasterFlags(item), item.mirrored,
                                  io::MeshletGroup{blockCount(), 0}, 0});
            }
            place(item);
            last = &item;
        }
        closeGroup();
    }

    std::vector<io::VisibleItem> items;
    std::vector<io::PlacedMeshlet> meshlets;
    std::vector<VisibilityGroup> groups;
    uint32_t triangle_count = 0;

  private:
    [[nodiscard]] uint32_t blockCount() const {
        return static_cast<uint32_t>(meshlets.size() / io::kCullGroup);
    }
    void closeGroup() {
        if (groups.empty()) {
            return;
        }
        while (meshlets.size() % io::kCullGroup != 0) {
            const auto any_of_group = static_cast<uint32_t>(items.size()) - 1;
            meshlets.push_back({any_of_group, io::kNoMeshlet, 0});
        }
        auto& blocks = groups.back().blocks;
        blocks.block_count = blockCount() - blocks.first_block;
    }
    void place(const DrawItem& item) {
        const auto& primitive = item.primitive;
        const auto item_index = static_cast<uint32_t>(items.size());
        items.push_back({item.instance, static_cast<uint32_t>(primitive.vertex_offset),
                         primitive.material, featuresOf(item.material_flags),
                         texturesOf(item.material_flags), static_cast<uint32_t>(groups.size()) - 1,
                         item.bends ? 1U : 0U});
        place(item_index, primitive.first_meshlet, primitive.meshlet_count);
        if (with_levels_) {
            place(item_index, primitive.first_coarser_meshlet, primitive.coarser_meshlet_count);
        }
    }
    void place(uint32_t item_index, uint32_t first, uint32_t count) {
        for (uint32_t i = first; i < first + count; ++i) {
            const Meshlet& m = scene_.meshlets[i];
            FROXEL_ASSERT(m.index_count <= 3U << io::kTriangleBits,
                          "an id has bits for every triangle of a meshlet");
            meshlets.push_back({item_index, i, m.first_index});
            triangle_count += m.index_count / 3;
        }
        groups.back().meshlet_count += count;
    }

    const SceneResources& scene_;
    const bool with_levels_;
};

} // namespace

std::string VisibilityScene::unusable(const SceneResources& scene,
                                      std::span<const DrawItem> drawn,
                                      Surfaces surfaces,
                                      Detail detail) {
    const gpu::Device& device = scene.shared.device;
    if (surfaces == Surfaces::kTransmissive && !VisibilityPipelines::canShadeTransmission(device)) {
        return "the device binds too few textures or descriptor sets";
    }
    if (const auto& lacks = device.traits().visibility_lacks; !lacks.empty()) {
        return "the device lacks " + lacks;
    }
    size_t meshlet_count = 0;
    for (const auto& item : drawn) {
        // Groups fill up workgroups: at most one a material and winding.
        const auto& primitive = item.primitive;
        const bool levels = detail == Detail::kLevels;
        meshlet_count +=
            isOf(surfaces, item.material_flags)
                ? primitive.meshlet_count + (levels ? primitive.coarser_meshlet_count : 0)
                : 0;
    }
    meshlet_count += size_t{io::kCullGroup} * 4 * (scene.material_uniforms.size() + 1);
    const size_t most = std::min(kMostMeshlets, size_t{io::kCullGroup} *
                                                    device.limits().maxComputeWorkGroupCount[0]);
    if (meshlet_count > most) {
        return "the scene has more than " + std::to_string(most) + " placed meshlets";
    }
    return {};
}

VisibilityScene::VisibilityScene(SceneResources& scene,
                                 std::span<const DrawItem> drawn,
                                 Surfaces surfaces_in,
                                 Detail detail,
                                 gpu::Uploader& uploader)
    : surfaces(surfaces_in), material_flags(flagsOf(drawn, surfaces)), arena(scene.shared.device),
      pipelines(scene.visibilityPipelines()), device_(scene.shared.device) {
    Placer placer(scene, drawn, surfaces, detail);
    groups = std::move(placer.groups);
    placed = std::move(placer.meshlets);
    triangle_count = placer.triangle_count;
    block_count = static_cast<uint32_t>(placed.size() / io::kCullGroup);
    std::vector<io::MeshletGroup> blocks;
    for (const auto& group : groups) {
        blocks.push_back(group.blocks);
    }
    for (const auto& item : placer.items) {
        item_instances.push_back(item.instance);
        materials_in_use.push_back(item.material_index);
    }
    std::sort(materials_in_use.begin(), materials_in_use.end());
    materials_in_use.erase(std::unique(materials_in_use.begin(), materials_in_use.end()),
                           materials_in_use.end());

    const auto fill = [&](auto&& table, std::string_view name) {
        return gpu::makeFilled(arena, uploader, std::forward<decltype(table)>(table),
                               Usage::eStorageBuffer, name);
    };
    items = fill(std::move(placer.items), "visible items");
    placed_meshlets = fill(placed, "placed meshlets");
    meshlets = fill(scene.meshlets, "meshlets");
    if (detail == Detail::kLevels) {
        details = fill(scene.details, "details of meshlets");
    }
    group_buffer = fill(std::move(blocks), "meshlet groups");
    materials = fill(scene.material_uniforms, "materials (storage)");
    if (scene.texturesAtOnce() > 0) {
        writeTextures(scene);
    }
    compute_unusable = ComputeRaster::unusable(device_, *this);
    words = *scene.word_buffer.handle;
    if (!words && compute_unusable.empty()) {
        own_words_ = fill(scene.meshlet_words, "meshlet words");
        words = *own_words_.handle;
    }
}

CulledDraws::CulledDraws(const gpu::Device& device, const VisibilityScene& scene) : arena(device) {
    const auto scratch = [&](size_t bytes, vk::BufferUsageFlags usage, const char* name) {
        return arena.makeBuffer(bytes, usage | Usage::eStorageBuffer, gpu::MemoryUse::kDevice,
                                name);
    };
    const size_t placed_count = scene.placed.size();
    commands = scratch(placed_count * sizeof(io::DrawCommand),
                       Usage::eIndirectBuffer | Usage::eTransferDst, "culled draws");
    ranks = scratch(placed_count * sizeof(uint32_t), {}, "cull ranks");
    counts = scratch((scene.groups.size() + scene.block_count) * sizeof(uint32_t),
                     Usage::eIndirectBuffer, "culled draw counts");
}

const CulledDraws& VisibilityScene::culledDraws() {
    if (!culled_draws_) {
        culled_draws_ = std::make_unique<CulledDraws>(device_, *this);
    }
    return *culled_draws_;
}

ComputeRaster& VisibilityScene::computeRaster() {
    if (!compute_raster_) {
        compute_raster_ = std::make_unique<ComputeRaster>(device_, *this, most_raster_triangles);
    }
    return *compute_raster_;
}

void VisibilityScene::writeTextures(const SceneResources& scene) {
    std::vector<vk::DescriptorImageInfo> textures = scene.material_textures;
    const uint32_t count = scene.texturesAtOnce();
    textures.resize(count, textures.front()); // every place has one
    const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, count};
    pool_ = gpu::makeDescriptorPool(scene.shared.device, std::array{size});
    texture_set_ = gpu::makeSet(scene.shared.device, pool_, pipelines.textureLayout());
    const vk::WriteDescriptorSet write{.dstSet = *texture_set_,
                                       .dstBinding = 0,
                                       .descriptorCount = count,
                                       .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                       .pImageInfo = textures.data()};
    scene.shared.device.handle().updateDescriptorSets(write, {});
}

VisibilityFrame::VisibilityFrame(const gpu::Device& device, const VisibilityScene& scene)
    : device_(device), pool_(nullptr) {
    using Type = vk::DescriptorType;
    const std::array sizes = {
        vk::DescriptorPoolSize{Type::eStorageBuffer, VisibilityPipelines::kBindings},
        vk::DescriptorPoolSize{Type::eSampledImage, 1},
        vk::DescriptorPoolSize{Type::eStorageImage, 3}};
    pool_ = gpu::makeDescriptorPool(device, sizes);
    set_ = gpu::makeSet(device, pool_, scene.pipelines.setLayout());
}

void VisibilityFrame::write(const Bindings& bindings) {
    const auto all = [](vk::Buffer buffer) {
        return vk::DescriptorBufferInfo{buffer, 0, VK_WHOLE_SIZE};
    };
    const auto whole = [&](const gpu::Buffer& buffer) { return all(*buffer.handle); };
    const auto& r = bindings.resources;
    const auto& v = bindings.vertices;
    const auto& s = bindings.scene;
    // What the frame lacks is described as none.
    const vk::DescriptorBufferInfo none{.buffer = {}, .offset = 0, .range = VK_WHOLE_SIZE};
    const auto* raster = bindings.raster;
    std::array<vk::DescriptorBufferInfo, VisibilityPipelines::kBindings> buffers = {
        all(v.positions),      all(v.surfaces),    all(v.extended ? v.extended : v.surfaces),
        whole(r.index_buffer), whole(s.items),     whole(s.placed_meshlets),
        whole(s.group_buffer), whole(s.materials), bindings.instances};
    const auto* draws = bindings.draws;
    buffers[9] = draws != nullptr ? whole(draws->commands) : none;
    buffers[10] = draws != nullptr ? whole(draws->ranks) : none;
    buffers[11] = draws != nullptr ? whole(draws->counts) : none;
    buffers[12] = bindings.order;
    buffers[15] =
        raster != nullptr ? vk::DescriptorBufferInfo{bindings.words, 0, VK_WHOLE_SIZE} : none;
    buffers[16] = raster != nullptr ? whole(raster->batches) : none;
    buffers[17] = raster != nullptr ? whole(raster->meshlets) : none;
    buffers[18] = raster != nullptr ? whole(raster->large) : none;
    buffers[21] = s.hasLevels() ? whole(s.details) : none;
    buffers[22] = whole(s.meshlets);
    buffers[23] = raster != nullptr ? all(s.words) : none;
    buffers[24] = bindings.tiles                                    ? all(bindings.tiles)
                  : raster != nullptr && *raster->far_depths.handle ? whole(raster->far_depths)
                                                                    : none;
    std::array<vk::DescriptorImageInfo, VisibilityPipelines::kBindings> images;
    const auto image = [&](uint32_t binding, vk::ImageView view) {
        images[binding] = {.imageView = view, .imageLayout = vk::ImageLayout::eGeneral};
    };
    image(13, bindings.ids);
    image(14, bindings.gbuffer);
    image(19, bindings.depth);
    image(20, bindings.ids);
    std::array<vk::WriteDescriptorSet, VisibilityPipelines::kBindings> writes;
    for (uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = {.dstSet = *set_,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = VisibilityPipelines::bindingType(i),
                     .pImageInfo = &images[i],
                     .pBufferInfo = &buffers[i]};
    }
    device_.handle().updateDescriptorSets(writes, {});
}

} // namespace froxel::render
