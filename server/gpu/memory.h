// Buffers and images over a few large allocations. An arena frees all of its memory at once, when
// it is destroyed, after everything placed in it.
#pragma once

#include "gpu/device.h"

#include <cstddef>
#include <cstdint>
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
};

// Linear sub-allocation from chunks. One thread.
class MemoryArena {
  public:
    // chunk_bytes: 0 gives every object an allocation of its own.
    MemoryArena(const Device& device, vk::DeviceSize chunk_bytes);
    MemoryArena(const MemoryArena&) = delete;
    MemoryArena& operator=(const MemoryArena&) = delete;

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
    };
    struct Place {
        vk::DeviceMemory memory;
        vk::DeviceSize offset = 0;
        std::byte* mapped = nullptr;
    };
    Place place(const vk::MemoryRequirements& requirements, MemoryUse use);

    const Device& device_;
    vk::DeviceSize chunk_bytes_;
    vk::DeviceSize allocated_bytes_ = 0;
    std::vector<Chunk> chunks_;
};

} // namespace froxel::gpu
