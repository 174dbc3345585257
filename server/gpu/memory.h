// Buffers and images over a few large allocations. An arena frees all of its memory at once, when
// it is destroyed, after everything placed in it.
#pragma once

#include "gpu/device.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::gpu {

enum class MemoryUse {
    kDevice,   // written and read by the device only
    kUpload,   // written by the host, read by the device (device-local where the host can reach it)
    kReadback, // written by the device, read by the host from its cache
};

struct Buffer {
    vk::raii::Buffer handle{nullptr};
    std::byte* mapped = nullptr; // kUpload and kReadback: coherent
    vk::DeviceSize size_bytes = 0;
};

struct Image {
    vk::raii::Image handle{nullptr};
    vk::raii::ImageView view{nullptr};
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    uint32_t mip_count = 1;
};

struct ImageInfo {
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    uint32_t mip_count = 1;
    vk::ImageUsageFlags usage = {};
    vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;
    vk::ImageCreateFlags flags = {};
    // Sampled by coordinates from 0 to 1, so exactly of this extent. Others may be made larger.
    bool filtered = false;
};

// Of the device's own memory, what this process may take: by VK_EXT_memory_budget, which knows of
// other processes, else all there is. Of a CPU device it says little: its memory is the host's.
[[nodiscard]] std::optional<uint64_t> deviceMemoryBytes(const Device& device);

// What makeImage() takes of memory; nothing is made.
[[nodiscard]] vk::DeviceSize imageBytes(const Device& device, const ImageInfo& info);

// Linear sub-allocation from chunks. One thread. What it allocates stands in the device's ledger.
class MemoryArena {
  public:
    // Every object has an allocation of its own, whose purpose is the object's name.
    explicit MemoryArena(const Device& device) : MemoryArena(device, 0, {}) {}
    // Objects share chunks, the next as large as all before it, up to chunk_bytes: at most half of
    // the arena is idle. purpose: of everything in it.
    MemoryArena(const Device& device, vk::DeviceSize chunk_bytes, std::string_view purpose);
    MemoryArena(const MemoryArena&) = delete;
    MemoryArena& operator=(const MemoryArena&) = delete;
    ~MemoryArena();

    // Both throw vk::OutOfDeviceMemoryError when memory is short.
    [[nodiscard]] Buffer makeBuffer(vk::DeviceSize size_bytes,
                                    vk::BufferUsageFlags usage,
                                    MemoryUse use,
                                    std::string_view name);
    [[nodiscard]] Image makeImage(const ImageInfo& info, std::string_view name);

    [[nodiscard]] vk::DeviceSize allocatedBytes() const { return allocated_bytes_; }

  private:
    struct Chunk {
        vk::raii::DeviceMemory memory{nullptr};
        uint32_t type = 0;
        vk::DeviceSize size_bytes = 0;
        vk::DeviceSize used_bytes = 0;
        std::byte* mapped = nullptr;
        std::string purpose;
    };
    struct Place {
        vk::DeviceMemory memory;
        vk::DeviceSize offset = 0;
        std::byte* mapped = nullptr;
    };
    Place place(const vk::MemoryRequirements& requirements, MemoryUse use, std::string_view name);

    const Device& device_;
    std::shared_ptr<MemoryLedger> ledger_;
    vk::DeviceSize chunk_bytes_;
    std::string purpose_; // empty: the objects' names
    vk::DeviceSize allocated_bytes_ = 0;
    std::vector<Chunk> chunks_;
};

} // namespace froxel::gpu
