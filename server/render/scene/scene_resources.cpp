#include "render/scene/scene_resources.h"

#include "core/error.h"
#include "core/text.h"
#include "gpu/pipeline.h"
#include "interface/frame_io.h"
#include "interface/visibility_io.h"
#include "render/pipelines/texture_limit.h"
#include "scene/material_variants.h"
#include "scene/scene_check.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace froxel::render {

namespace {

constexpr vk::DeviceSize kTextureChunkBytes = 64U << 20U;
constexpr uint32_t kFewestTextures = 256; // that there is room for where shaders read all

// Stands for an infinite index of refraction.
constexpr float kInfiniteIor = 1e6F;

io::UvTransform uvTransform(const scene::TextureSlot& slot) {
    const float c = std::cos(slot.rotation_rad);
    const float s = std::sin(slot.rotation_rad);
    return {.row0 = {c * slot.scale.x, s * slot.scale.y, slot.offset.x},
            .row1 = {-s * slot.scale.x, c * slot.scale.y, slot.offset.y},
            .texcoord = slot.texcoord,
            .padding0 = 0};
}

io::Material materialUniforms(const scene::Material& m) {
    const float root = (m.ior - 1) / (m.ior + 1);
    io::Material out{.base_color = m.base_color,
                     .emissive = m.emissive,
                     .metallic = m.metallic,
                     .roughness = m.roughness,
                     .normal_scale = m.normal_scale,
                     .occlusion_strength = m.occlusion_strength,
                     .alpha_cutoff = m.alpha_cutoff,
                     .specular_f0 = m.specular_color * (root * root),
                     .specular = m.specular,
                     .ior = m.ior == 0 ? kInfiniteIor : m.ior,
                     .padding0 = 0,
                     .padding1 = 0,
                     .padding2 = 0,
#define FROXEL_MEMBER(type, name) .name = m.name,
                     FROXEL_MATERIAL_FACTORS(FROXEL_MEMBER)
#undef FROXEL_MEMBER
                         .uv = {}};
    const auto slots = textureSlots(m);
    std::ranges::transform(slots, out.uv, [](const auto* slot) { return uvTransform(*slot); });
    return out;
}

std::vector<glm::dmat4> placesOf(const scene::Scene& scene, const SceneMotion* motion) {
    if (motion != nullptr) {
        motion::Moment start;
        motion->player.at(motion->clips, 0, start);
        return start.instances;
    }
    std::vector<glm::dmat4> places;
    for (const auto& instance : scene.instances) {
        places.push_back(instance.world_from_object);
    }
    return places;
}

MaterialFlags itemFlags(const PackedPrimitive& primitive, const SceneNeeds& needs) {
    return needs.material_flags[primitive.material] |
           (primitive.extended ? io::kMaterialExtended : 0U) |
           (primitive.tangents ? io::kMaterialTangents : 0U);
}

std::vector<DrawItem> makeItems(const scene::Scene& scene,
                                const PackedGeometry& geometry,
                                const SceneNeeds& needs,
                                const SceneMotion* motion,
                                std::span<const glm::dmat4> places) {
    std::vector<DrawItem> items;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const bool mirrored = glm::determinant(glm::dmat3(places[i])) < 0;
        const bool bends = motion != nullptr && motion->deformed_of_instance[i] != scene::kNone;
        for (const auto& primitive : geometry.meshes[scene.instances[i].mesh]) {
            if (primitive.index_count == 0) {
                continue;
            }
            items.push_back({i, primitive, itemFlags(primitive, needs), mirrored, bends});
        }
    }
    return items;
}

// What of the scene this device draws.
SceneNeeds drawableNeeds(const gpu::Device& device, const scene::Scene& scene) {
    SceneNeeds all = findNeeds(scene);
    const auto layered = [](MaterialFlags flags) { return (flags & kLayerFlags) != 0; };
    if (materialSlots(device.traits()) == io::kMaterialSlots ||
        std::ranges::none_of(all.material_flags, layered)) {
        return all;
    }
    spdlog::warn("event=layers_left_out reason=\"layers need {} sampled descriptors in a shader, "
                 "{} of them with samplers; this device allows {} and {}\"",
                 kPassTextures + io::kMaterialSlots, io::kMaterialSlots,
                 device.traits().most_textures, device.traits().most_samplers);
    return findNeeds(scene, false);
}

} // namespace

SceneResources::SceneResources(DeviceResources& shared_in,
                               const scene::Scene& scene,
                               gpu::Uploader& uploader)
    : shared(shared_in), needs(drawableNeeds(shared.device, scene)),
      bounds_world(scene.bounds_world), light_rig(scene), surroundings(scene.surroundings),
      memory(shared.memory), arena(shared.device),
      texture_arena(shared.device, kTextureChunkBytes, "textures") {
    if (const auto fault = scene::findFault(scene)) {
        throw StartupError({ErrorCode::kScene, *fault});
    }
    auto geometry = packGeometry(scene, {.detail_levels = shared.scene_options.detail_levels,
                                         .cache_folder = shared.scene_options.geometry_cache});
    if (scene.motion) {
        motion = std::make_unique<const SceneMotion>(shared, arena, uploader, scene, geometry);
    }
    instances = placesOf(scene, motion.get());
    auto items = makeItems(scene, geometry, needs, motion.get(), instances);
    keepVariantMaterials(scene, geometry);
    meshlets = std::move(geometry.triangles.meshlets);
    details = std::move(geometry.details);
    uploadGeometry(std::move(geometry), uploader);
    uploadMaterials(scene, uploader);
    undressed_ = std::make_shared<MaterialSet>(*this, std::move(items));
    spdlog::info("event=scene_packed scene={} items={} meshlets={} images={} device_bytes={}",
                 logValue(scene.name), undressed_->items.size(), meshlets.size(),
                 textures_->imageCount(), arena.allocatedBytes() + texture_arena.allocatedBytes());
}

void SceneResources::settle() {
    memory.add(arena.allocatedBytes() + texture_arena.allocatedBytes());
}

void SceneResources::uploadGeometry(PackedGeometry&& geometry, gpu::Uploader& uploader) {
    using Usage = vk::BufferUsageFlagBits;
    auto vertices = Usage::eVertexBuffer | Usage::eStorageBuffer;
    if (poser() != nullptr) {
        vertices |= Usage::eTransferSrc; // to PosedVertices
    }
    constexpr auto kIndices = Usage::eIndexBuffer | Usage::eStorageBuffer;
    if (shared.device.traits().is_cpu) {
        meshlet_words = std::move(geometry.triangles.words);
        positions = std::move(geometry.positions);
        position_buffer = gpu::makeFilled(arena, uploader, positions, vertices, "positions");
    } else {
        position_buffer =
            gpu::makeFilled(arena, uploader, std::move(geometry.positions), vertices, "positions");
        if (shared.device.traits().int64_atomics) {
            word_buffer = gpu::makeFilled(arena, uploader, std::move(geometry.triangles.words),
                                          Usage::eStorageBuffer, "meshlet words");
        }
    }
    index_buffer = gpu::makeFilled(arena, uploader, std::move(geometry.triangles.indices), kIndices,
                                   "indices");
    surface_buffer = gpu::makeFilled(arena, uploader, std::move(geometry.surfaces), vertices,
                                     "surface vertices");
    if (!geometry.extended.empty()) {
        extended_buffer = gpu::makeFilled(arena, uploader, std::move(geometry.extended), vertices,
                                          "extended vertices");
    }
}

void SceneResources::makeMaterialSets(uint32_t count) {
    const std::array pool_sizes = {
        vk::DescriptorPoolSize{vk::DescriptorType::eUniformBuffer, count},
        vk::DescriptorPoolSize{vk::DescriptorType::eCombinedImageSampler,
                               count * materialSlots(shared.device.traits())}};
    material_pool_ = gpu::makeDescriptorPool(shared.device, pool_sizes, count);
    const std::vector layouts(count, shared.pipelines.materialLayout());
    material_sets_ =
        shared.device.handle().allocateDescriptorSets({.descriptorPool = *material_pool_,
                                                       .descriptorSetCount = count,
                                                       .pSetLayouts = layouts.data()});
}

void SceneResources::uploadMaterials(const scene::Scene& scene, gpu::Uploader& uploader) {
    textures_ = std::make_unique<TextureStore>(shared.device, texture_arena);
    const auto count = static_cast<uint32_t>(scene.materials.size());
    if (count == 0) {
        return;
    }
    makeMaterialSets(count);
    const auto alignment = shared.device.limits().minUniformBufferOffsetAlignment;
    const vk::DeviceSize stride = (sizeof(io::Material) + alignment - 1) / alignment * alignment;
    std::vector<std::byte> bytes(stride * count);
    for (uint32_t i = 0; i < count; ++i) {
        const auto uniforms = materialUniforms(scene.materials[i]);
        std::memcpy(bytes.data() + stride * i, &uniforms, sizeof(uniforms));
        material_uniforms.push_back(uniforms);
    }
    material_buffer_ = gpu::makeFilled(arena, uploader, std::move(bytes),
                                       vk::BufferUsageFlagBits::eUniformBuffer, "materials");
    for (uint32_t i = 0; i < count; ++i) {
        const auto& m = scene.materials[i];
        const vk::DescriptorBufferInfo buffer{*material_buffer_.handle, stride * i,
                                              sizeof(io::Material)};
        const auto slots = textureSlots(m);
        std::array<vk::DescriptorImageInfo, io::kMaterialSlots> images;
        for (uint32_t slot = 0; slot < slots.size(); ++slot) {
            // Only what the material's shader samples.
            const bool used = (needs.material_flags[i] & textureFlag(slot)) != 0;
            images[slot] = textures_->get(scene, used ? *slots[slot] : scene::TextureSlot{},
                                          scene::kSlotRows[slot].srgb, uploader);
        }
        material_textures.insert(material_textures.end(), images.begin(), images.end());
        // The samplers are consecutive bindings of one descriptor each.
        const std::array writes = {
            vk::WriteDescriptorSet{.dstSet = *material_sets_[i],
                                   .dstBinding = 0,
                                   .descriptorCount = 1,
                                   .descriptorType = vk::DescriptorType::eUniformBuffer,
                                   .pBufferInfo = &buffer},
            vk::WriteDescriptorSet{.dstSet = *material_sets_[i],
                                   .dstBinding = 1,
                                   .descriptorCount = materialSlots(shared.device.traits()),
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .pImageInfo = images.data()}};
        shared.device.handle().updateDescriptorSets(writes, {});
    }
}

void SceneResources::keepVariantMaterials(const scene::Scene& scene,
                                          const PackedGeometry& geometry) {
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const auto& primitives = scene.meshes[m].primitives;
        for (size_t p = 0; p < primitives.size(); ++p) {
            const PackedPrimitive& packed = geometry.meshes[m][p];
            if (packed.index_count > 0 && !primitives[p].variant_materials.empty()) {
                variant_materials_.emplace(packed.first_index, primitives[p].variant_materials);
            }
        }
    }
}

std::shared_ptr<MaterialSet> SceneResources::materialsOfVariant(uint32_t material_variant) {
    if (material_variant == 0) {
        return undressed_;
    }
    std::weak_ptr<MaterialSet>& known = known_material_sets_[material_variant];
    if (auto material_set = known.lock()) {
        return material_set;
    }
    std::vector<DrawItem> items = undressed_->items;
    for (DrawItem& item : items) {
        const auto materials = variant_materials_.find(item.primitive.first_index);
        if (materials != variant_materials_.end()) {
            uint32_t& material = item.primitive.material;
            material = scene::materialIn(material_variant, material, materials->second);
            item.material_flags = itemFlags(item.primitive, needs);
        }
    }
    auto material_set = std::make_shared<MaterialSet>(*this, std::move(items));
    known = material_set;
    return material_set;
}

VisibilityPipelines& SceneResources::visibilityPipelines() const {
    return shared.visibilityPipelines(texturesAtOnce());
}

uint32_t SceneResources::texturesAtOnce() const {
    const auto& traits = shared.device.traits();
    const auto all = static_cast<uint32_t>(material_textures.size());
    // So that scenes of about as many have their pipelines together.
    const uint32_t places = std::bit_ceil(std::max(all, kFewestTextures));
    return traits.descriptor_indexing && all > 0 &&
                   places + kPassTextures <= traits.most_textures && places <= traits.most_samplers
               ? places
               : 0;
}

} // namespace froxel::render
