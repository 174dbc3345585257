// PNG and JPEG files as RGBA8. Colour profiles and gamma chunks are ignored, as glTF asks.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace froxel::gltf {

struct ImageSize {
    uint32_t width_px = 0;
    uint32_t height_px = 0;

    [[nodiscard]] uint64_t decodedBytes() const { return uint64_t{width_px} * height_px * 4; }
};

// Size by the file's header alone. Throws Failure, naming `user`, for a file that is neither PNG
// nor JPEG, and for sides of 0 or above kMaxImageSide_px.
[[nodiscard]] ImageSize imageSize(std::span<const std::byte> file, const std::string& user);

// Fills width, height and pixels of `image`: grey and palette become RGB, no alpha becomes 255,
// 16 bits become 8. Returns a warning or "". Throws Failure, naming `user`, where the data is
// broken. Any thread.
std::string
decodeImage(std::span<const std::byte> file, const std::string& user, scene::Image& image);

} // namespace froxel::gltf
