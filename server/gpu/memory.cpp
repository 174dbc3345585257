#include "gpu/memory.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

namespace froxel::gpu {

namespace {

using Property = vk::MemoryPropertyFlagBits;

std::optional<uint32_t> findType(const vk::PhysicalDeviceMemoryProperties& memory,
                                 uint32_t allowed,
                                 vk::MemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const bool fits = (memory.memoryTypes[i].propertyFlags & wanted) == wanted;
        if ((allowed & (1U << i)) != 0 && fits) {
            return i;
        }
    }
    return std::nullopt;
}

// Best kind first.
std::vector<vk::MemoryPropertyFlags> preferences(MemoryUse use) {
    const vk::MemoryPropertyFlags host = Property::eHostVisible | Property::eHostCoherent;
    switch (use) {
    case MemoryUse::kDevice:
        return {Property::eDeviceLocal, {}};
    case MemoryUse::kUpload:
        return {host | Property::eDeviceLocal, host};
    case MemoryUse::kReadback:
        return {host | Property::eHostCached, host};
    }
    return {};
}

vk::DeviceSize alignUp(vk::DeviceSize value, vk::DeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

constexpr vk::DeviceSize kLeastBuffer = 16;

// llvmpipe compiles a shader anew for pictures and texel buffers whose sizes are powers of two,
// while it runs it: for up to 2 s. So none are.
template <class Size>
Size neverPowerOfTwo(const Device& device, Size size, Size step) {
    return device.traits().is_cpu && std::has_single_bit(size) ? size + step : size;
}

vk::ImageCreateInfo createInfo(const Device& device, const ImageInfo& info) {
    const auto side = [&](uint32_t texels) {
        return info.filtered ? texels : neverPowerOfTwo(device, texels, 1U);
    };
    return {.flags = info.flags,
            .imageType = vk::ImageType::e2D,
            .format = info.format,
            .extent = {side(info.extent.width), side(info.extent.height), 1},
            .mipLevels = info.mip_count,
            .arrayLayers = 1,
            .samples = vk::SampleCountFlagBits::e1,
            .tiling = vk::ImageTiling::eOptimal,
            .usage = info.usage};
}

} // namespace

std::optional<uint64_t> deviceMemoryBytes(const Device& device) {
    const auto extensions = device.physical().enumerateDeviceExtensionProperties();
    const bool has_budget =
        std::any_of(extensions.begin(), extensions.end(), [](const auto& extension) {
            return std::string_view(extension.extensionName) == VK_EXT_MEMORY_BUDGET_EXTENSION_NAME;
        });
    const auto chain = device.physical()
                           .getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2,
                                                 vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    const auto& heaps = chain.get<vk::PhysicalDeviceMemoryProperties2>().memoryProperties;
    const auto& budget = chain.get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    std::optional<uint64_t> largest;
    for (uint32_t i = 0; i < heaps.memoryHeapCount; ++i) {
        if (heaps.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            const uint64_t bytes = has_budget ? budget.heapBudget[i] : heaps.memoryHeaps[i].size;
            largest = std::max(largest.value_or(0), bytes);
        }
    }
    return largest;
}

vk::DeviceSize imageBytes(const Device& device, const ImageInfo& info) {
    const auto create_info = createInfo(device, info);
    return device.handle()
        .getImageMemoryRequirements({.pCreateInfo = &create_info})
        .memoryRequirements.size;
}

MemoryArena::MemoryArena(const Device& device, vk::DeviceSize chunk_bytes, std::string_view purpose)
    : device_(device), ledger_(device.memoryLedger()), chunk_bytes_(chunk_bytes),
      purpose_(purpose) {}

MemoryArena::~MemoryArena() {
    for (const Chunk& chunk : chunks_) {
        ledger_->remove(chunk.purpose, chunk.size_bytes);
    }
}

MemoryArena::Place MemoryArena::place(const vk::MemoryRequirements& requirements,
                                      MemoryUse use,
                                      std::string_view name) {
    std::optional<uint32_t> type;
    for (const auto flags : preferences(use)) {
        type = findType(device_.memory(), requirements.memoryTypeBits, flags);
        if (type) {
            break;
        }
    }
    if (!type) {
        throw StartupError({ErrorCode::kDevice, "no memory type suits a buffer or image"});
    }
    // Images and buffers may share a chunk, so keep both apart by the device's granularity.
    const auto alignment =
        std::max(requirements.alignment, device_.limits().bufferImageGranularity);
    for (auto& chunk : chunks_) {
        const auto offset = alignUp(chunk.used_bytes, alignment);
        if (chunk.type == *type && offset + requirements.size <= chunk.size_bytes) {
            chunk.used_bytes = offset + requirements.size;
            return {*chunk.memory, offset, chunk.mapped ? chunk.mapped + offset : nullptr};
        }
    }
    Chunk chunk;
    chunk.type = *type;
    chunk.size_bytes = std::max(requirements.size, std::min(chunk_bytes_, allocated_bytes_));
    chunk.purpose = purpose_.empty() ? name : std::string_view(purpose_);
    chunk.memory = device_.handle().allocateMemory(
        {.allocationSize = chunk.size_bytes, .memoryTypeIndex = *type});
    if (use != MemoryUse::kDevice) {
        chunk.mapped = static_cast<std::byte*>(chunk.memory.mapMemory(0, VK_WHOLE_SIZE));
    }
    chunk.used_bytes = requirements.size;
    allocated_bytes_ += chunk.size_bytes;
    ledger_->add(chunk.purpose, chunk.size_bytes);
    chunks_.push_back(std::move(chunk));
    return {*chunks_.back().memory, 0, chunks_.back().mapped};
}

Buffer MemoryArena::makeBuffer(vk::DeviceSize size_bytes,
                               vk::BufferUsageFlags usage,
                               MemoryUse use,
                               std::string_view name) {
    Buffer buffer;
    buffer.size_bytes = std::max(size_bytes, kLeastBuffer);
    const bool texels = static_cast<bool>(usage & vk::BufferUsageFlagBits::eUniformTexelBuffer);
    vk::BufferCreateInfo info{.size =
                                  texels ? neverPowerOfTwo(device_, buffer.size_bytes, kLeastBuffer)
                                         : buffer.size_bytes,
                              .usage = usage};
    // What may be copied to the host, and to where.
    const Queue* copies = device_.copyQueue();
    const std::array families = {device_.queue().family,
                                 copies != nullptr ? copies->family : device_.queue().family};
    const bool is_copied = static_cast<bool>(usage & vk::BufferUsageFlagBits::eTransferSrc);
    if (families[0] != families[1] && (is_copied || use == MemoryUse::kReadback)) {
        info.sharingMode = vk::SharingMode::eConcurrent;
        info.queueFamilyIndexCount = static_cast<uint32_t>(families.size());
        info.pQueueFamilyIndices = families.data();
    }
    buffer.handle = device_.handle().createBuffer(info);
    const Place at = place(buffer.handle.getMemoryRequirements(), use, name);
    buffer.handle.bindMemory(at.memory, at.offset);
    buffer.mapped = at.mapped;
    device_.setName(*buffer.handle, name);
    return buffer;
}

Image MemoryArena::makeImage(const ImageInfo& info, std::string_view name) {
    Image image;
    image.format = info.format;
    image.extent = info.extent;
    image.mip_count = info.mip_count;
    image.handle = device_.handle().createImage(createInfo(device_, info));
    const Place at = place(image.handle.getMemoryRequirements(), MemoryUse::kDevice, name);
    image.handle.bindMemory(at.memory, at.offset);
    image.view = device_.handle().createImageView(
        {.image = *image.handle,
         .viewType = vk::ImageViewType::e2D,
         .format = info.format,
         .subresourceRange = {info.aspect, 0, info.mip_count, 0, 1}});
    device_.setName(*image.handle, name);
    device_.setName(*image.view, name);
    return image;
}

} // namespace froxel::gpu
