// A scene's textures on the device: each image once for each encoding in use, with mip chains.
#pragma once

#include "gpu/memory.h"
#include "gpu/upload.h"
#include "render/texel_pack.h"
#include "scene/scene.h"

#include <array>
#include <map>
#include <utility>

namespace froxel::render {

// A material's packed texels on the device.
struct PackedTexture {
    gpu::Buffer buffer;
    vk::raii::BufferView view{nullptr};
    glm::uvec2 log2_size{0};
    uint32_t last_level = 0;
};

class TextureStore {
  public:
    TextureStore(const gpu::Device& device, gpu::MemoryArena& arena, gpu::Uploader& uploader);

    // The descriptor of a slot's texture; of nothing where the slot has none. `srgb` says how the
    // colours are encoded. Throws vk::SystemError.
    [[nodiscard]] vk::DescriptorImageInfo
    get(const scene::Scene& scene, const scene::TextureSlot& slot, bool srgb);

    // The packed texels of the slots that `plan` names; where it names none, an entry that nothing
    // reads. Materials with the same slots share one. Throws vk::SystemError.
    [[nodiscard]] const PackedTexture&
    pack(const scene::Scene& scene, const scene::Material& material, const PackPlan& plan);

    [[nodiscard]] size_t imageCount() const { return images_.size(); }

  private:
    const gpu::Image& image(const scene::Image& source, uint32_t index, bool srgb);
    vk::Sampler sampler(const scene::Sampler& settings);

    const gpu::Device& device_;
    gpu::MemoryArena& arena_;
    gpu::Uploader& uploader_;
    std::map<std::pair<uint32_t, bool>, gpu::Image> images_; // by image index and encoding
    gpu::MemoryArena pack_arena_;
    // By plan and the images of its slots.
    std::map<std::pair<PackPlan, std::array<uint32_t, 3>>, PackedTexture> packs_;
    std::vector<std::pair<scene::Sampler, vk::raii::Sampler>> samplers_;
};

} // namespace froxel::render
