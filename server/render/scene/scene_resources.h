// A scene on the device, and what every viewer of it shares.
#pragma once

#include "gpu/memory.h"
#include "light/light_rig.h"
#include "render/device/device_resources.h"
#include "render/pipelines/typed_store.h"
#include "render/scene/geometry_pack.h"
#include "render/scene/material_set.h"
#include "render/scene/scene_motion.h"
#include "render/scene/scene_needs.h"
#include "render/scene/texture_store.h"
#include "render/scene/visibility_scene.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace froxel::render {

inline constexpr vk::DeviceSize kStagingBytes = 16U << 20U; // of what all of a scene has

class SceneResources {
  public:
    // On any thread, while the render thread draws others. What the uploader is to do refers to the
    // scene and to this; before that is done, and settle() was called, nothing may be drawn of it.
    // Throws StartupError, vk::SystemError.
    SceneResources(DeviceResources& shared, const scene::Scene& scene, gpu::Uploader& uploader);
    // From now on it counts in the device's memory.
    void settle();
    SceneResources(const SceneResources&) = delete;
    SceneResources& operator=(const SceneResources&) = delete;

    DeviceResources& shared; // with other scenes
    const SceneNeeds needs;
    const BoundsD3 bounds_world;
    const light::LightRig light_rig;
    const std::shared_ptr<const environment::Surroundings> surroundings; // scene::Scene's
    SceneMemory memory;

    // As they stand at time 0, where the scene moves; a frame has its ScenePose. bounds_world and
    // the rig's seeded lights are over all clips.
    std::vector<glm::dmat4> instances; // world_from_object
    std::vector<Meshlet> meshlets;
    std::vector<MeshletDetail> details; // of each; empty: there are no coarser levels
    // The host's copies, for culling by triangle; empty on a GPU, which does not.
    std::vector<uint32_t> meshlet_words; // MeshletList::words
    std::vector<glm::vec3> positions;
    std::unique_ptr<const SceneMotion> motion; // null: all of it rests

    gpu::MemoryArena arena; // geometry and materials
    gpu::MemoryArena texture_arena;
    gpu::Buffer position_buffer;
    gpu::Buffer surface_buffer;
    gpu::Buffer extended_buffer; // empty handle: no primitive needs it
    gpu::Buffer index_buffer;
    // MeshletList::words, where a GPU rasters by them; a CPU's rare frames that do have their own.
    gpu::Buffer word_buffer;
    std::vector<io::Material> material_uniforms;
    std::vector<vk::DescriptorImageInfo> material_textures; // kMaterialSlots of each
    // Fragments that pass the depth test, per pixel of the picture: of the first frame that the
    // rasteriser draws. None: not measured yet.
    std::optional<double> overdraw;

    // What views with this error draw.
    [[nodiscard]] Detail detailOf(float geometry_error_px) const {
        return geometry_error_px > 0 && !details.empty() ? Detail::kLevels : Detail::kExact;
    }
    // Null: no mesh bends.
    [[nodiscard]] const MeshPoser* poser() const { return motion ? motion->poser.get() : nullptr; }
    // What of this scene views that ask for it share: made from this at the first call. Throws
    // vk::SystemError.
    template <class T>
    [[nodiscard]] T& stored() {
        return stored_.findOrMake<T>(*this);
    }
    // That of a material variant, by its number (settings::ViewSettings). All who hold it share it;
    // with the last of them it goes, but for that of no variant.
    [[nodiscard]] std::shared_ptr<MaterialSet> materialsOfVariant(uint32_t material_variant);
    // Throws vk::SystemError.
    [[nodiscard]] VisibilityPipelines& visibilityPipelines() const;

    // Room for the textures of all materials, where a shader may read them at once; else 0.
    [[nodiscard]] uint32_t texturesAtOnce() const;

    [[nodiscard]] vk::DescriptorSet materialSet(uint32_t material) const {
        return *material_sets_[material];
    }

  private:
    void uploadGeometry(PackedGeometry&& geometry, gpu::Uploader& uploader);
    void keepVariantMaterials(const scene::Scene& scene, const PackedGeometry& geometry);
    void makeMaterialSets(uint32_t count);
    void uploadMaterials(const scene::Scene& scene, gpu::Uploader& uploader);

    gpu::Buffer material_buffer_;
    std::unique_ptr<TextureStore> textures_;
    vk::raii::DescriptorPool material_pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> material_sets_;
    std::shared_ptr<MaterialSet> undressed_; // of no variant
    std::map<uint32_t, std::weak_ptr<MaterialSet>> known_material_sets_;
    // Of primitives that have any, by PackedPrimitive::first_index, which no two share.
    std::map<uint32_t, std::vector<scene::VariantMaterial>> variant_materials_;
    TypedStore stored_;
};

} // namespace froxel::render
