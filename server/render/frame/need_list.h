// What a frame takes of memory, item by item. Pure, but for what the device says of its images.
#pragma once

#include "core/frame_stats.h"
#include "gpu/memory.h"

#include <functional>
#include <string>
#include <vector>

namespace froxel::render {

// What an image takes: gpu::imageBytes.
using ImageBytes = std::function<uint64_t(const gpu::ImageInfo&)>;

// Collects what a frame needs.
class NeedList {
  public:
    explicit NeedList(const ImageBytes& image_bytes) : image_bytes_(image_bytes) {}

    void image(const std::string& purpose, const gpu::ImageInfo& info) {
        uses.push_back({purpose, image_bytes_(info)});
    }
    void buffer(const std::string& purpose, uint64_t bytes); // 0: none

    std::vector<MemoryUse> uses;

  private:
    const ImageBytes& image_bytes_;
};

} // namespace froxel::render
