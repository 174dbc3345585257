// Loading data into device memory through one staging buffer. For start-up, not for frames.
#pragma once

#include "gpu/command_context.h"
#include "gpu/memory.h"

#include <cstddef>
#include <span>

namespace froxel::gpu {

class Uploader {
  public:
    Uploader(const Device& device, Timeline& timeline, vk::DeviceSize staging_bytes);

    // Fills the buffer from offset 0; waits.
    void upload(const Buffer& target, std::span<const std::byte> data);
    // Fills the first levels with tightly packed texels, makes the others by linear blits (in
    // linear light for sRGB formats) and leaves the image ready for sampling; waits.
    void uploadImage(const Image& target, std::span<const std::span<const std::byte>> levels);

  private:
    void grow(vk::DeviceSize bytes);

    const Device& device_;
    Timeline& timeline_;
    MemoryArena arena_;
    Buffer staging_;
};

} // namespace froxel::gpu
