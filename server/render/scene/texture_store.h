// A scene's textures on the device: each image once for each encoding in use, with mip chains.
#pragma once

#include "core/visibility.h"
#include "gpu/memory.h"
#include "gpu/upload.h"
#include "scene/scene.h"

#include <map>
#include <utility>

namespace froxel::render {

// Of the scene's textures. A software device's own arithmetic is not what it states: as if exact.
[[nodiscard]] TextureFilter textureFilter(const gpu::Device& device);

class TextureStore {
  public:
    TextureStore(const gpu::Device& device, gpu::MemoryArena& arena);

    // The descriptor of a slot's texture; of nothing where the slot has none. `srgb` says how the
    // colours are encoded. What is new is noted with the uploader, of the scene's own texels.
    // Throws vk::SystemError.
    [[nodiscard]] vk::DescriptorImageInfo get(const scene::Scene& scene,
                                              const scene::TextureSlot& slot,
                                              bool srgb,
                                              gpu::Uploader& uploader);

    [[nodiscard]] size_t imageCount() const { return images_.size(); }

  private:
    const gpu::Image&
    image(const scene::Image& source, uint32_t index, bool srgb, gpu::Uploader& uploader);
    vk::Sampler sampler(const scene::Sampler& settings);

    const gpu::Device& device_;
    gpu::MemoryArena& arena_;
    std::map<std::pair<uint32_t, bool>, gpu::Image> images_; // by image index and encoding
    std::vector<std::pair<scene::Sampler, vk::raii::Sampler>> samplers_;
};

} // namespace froxel::render
