#include "render/scene/texture_store.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace froxel::render {

namespace {

// Sharp at grazing angles where the hardware does it; a software rasteriser pays for every tap.
constexpr float kGpuAnisotropy = 8.0F;

vk::SamplerAddressMode addressMode(scene::Wrap wrap) {
    switch (wrap) {
    case scene::Wrap::kRepeat:
        return vk::SamplerAddressMode::eRepeat;
    case scene::Wrap::kMirroredRepeat:
        return vk::SamplerAddressMode::eMirroredRepeat;
    case scene::Wrap::kClampToEdge:
        return vk::SamplerAddressMode::eClampToEdge;
    }
    return vk::SamplerAddressMode::eRepeat;
}

vk::Filter filter(scene::Filter value) {
    return value == scene::Filter::kLinear ? vk::Filter::eLinear : vk::Filter::eNearest;
}

} // namespace

TextureFilter textureFilter(const gpu::Device& device) {
    if (device.traits().is_cpu) {
        return {};
    }
    return {
        .max_anisotropy = std::min(kGpuAnisotropy, device.traits().max_anisotropy),
        .weight_step = std::exp2(-static_cast<double>(device.limits().subTexelPrecisionBits)),
        .level_step = std::exp2(-static_cast<double>(device.limits().mipmapPrecisionBits)),
    };
}

TextureStore::TextureStore(const gpu::Device& device, gpu::MemoryArena& arena)
    : device_(device), arena_(arena) {}

vk::DescriptorImageInfo TextureStore::get(const scene::Scene& scene,
                                          const scene::TextureSlot& slot,
                                          bool srgb,
                                          gpu::Uploader& uploader) {
    constexpr auto kLayout = vk::ImageLayout::eShaderReadOnlyOptimal;
    if (slot.texture == scene::kNone) {
        return {.sampler = sampler({}), .imageLayout = kLayout};
    }
    const auto& texture = scene.textures[slot.texture];
    const auto settings =
        texture.sampler != scene::kNone ? scene.samplers[texture.sampler] : scene::Sampler{};
    const auto& chosen = image(scene.images[texture.image], texture.image, srgb, uploader);
    return {.sampler = sampler(settings), .imageView = *chosen.view, .imageLayout = kLayout};
}

const gpu::Image& TextureStore::image(const scene::Image& source,
                                      uint32_t index,
                                      bool srgb,
                                      gpu::Uploader& uploader) {
    const auto key = std::pair(index, srgb);
    if (const auto found = images_.find(key); found != images_.end()) {
        return found->second;
    }
    using Usage = vk::ImageUsageFlagBits;
    const auto mips =
        static_cast<uint32_t>(std::bit_width(std::max(source.width_px, source.height_px)));
    auto made =
        arena_.makeImage({.format = srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                          .extent = {source.width_px, source.height_px},
                          .mip_count = mips,
                          .usage = Usage::eSampled | Usage::eTransferDst | Usage::eTransferSrc,
                          .filtered = true},
                         source.name);
    std::vector<std::span<const std::byte>> levels{source.rgba8};
    levels.insert(levels.end(), source.mips.begin(), source.mips.end());
    uploader.uploadImage(made, levels);
    return images_.emplace(key, std::move(made)).first->second;
}

vk::Sampler TextureStore::sampler(const scene::Sampler& settings) {
    const auto found = std::find_if(samplers_.begin(), samplers_.end(),
                                    [&](const auto& entry) { return entry.first == settings; });
    if (found != samplers_.end()) {
        return *found->second;
    }
    const auto max_anisotropy = static_cast<float>(textureFilter(device_).max_anisotropy);
    const bool anisotropic =
        max_anisotropy > 1 && settings.min == scene::Filter::kLinear && settings.mipmapped;
    samplers_.emplace_back(
        settings,
        device_.handle().createSampler({.magFilter = filter(settings.mag),
                                        .minFilter = filter(settings.min),
                                        .mipmapMode = settings.mip == scene::Filter::kLinear
                                                          ? vk::SamplerMipmapMode::eLinear
                                                          : vk::SamplerMipmapMode::eNearest,
                                        .addressModeU = addressMode(settings.wrap_u),
                                        .addressModeV = addressMode(settings.wrap_v),
                                        .anisotropyEnable = anisotropic,
                                        .maxAnisotropy = max_anisotropy,
                                        .maxLod = settings.mipmapped ? VK_LOD_CLAMP_NONE : 0.0F}));
    return *samplers_.back().second;
}

} // namespace froxel::render
