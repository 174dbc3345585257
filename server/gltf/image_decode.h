// PNG, JPEG, WebP and KTX2 files as RGBA8, told apart by their first bytes. Colour profiles and
// gamma chunks are ignored, as glTF asks.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace froxel::gltf {

struct ImageSize {
    uint32_t width_px = 0;
    uint32_t height_px = 0;

    uint32_t level_count = 1; // that the file gives

    [[nodiscard]] uint64_t levelBytes(uint32_t level) const {
        return uint64_t{std::max(1U, width_px >> level)} * std::max(1U, height_px >> level) * 4;
    }
    [[nodiscard]] uint64_t decodedBytes() const {
        uint64_t bytes = 0;
        for (uint32_t level = 0; level < level_count; ++level) {
            bytes += levelBytes(level);
        }
        return bytes;
    }
};

// "image/png" and the like, by the file's first bytes; "" for what is none of the four.
[[nodiscard]] std::string_view imageType(std::span<const std::byte> file);

// Size by the file's header alone. Throws Unusable, naming `user`, for a file of another format and
// a broken one, Failure for sides above kMaxImageSide_px.
[[nodiscard]] ImageSize imageSize(std::span<const std::byte> file, const std::string& user);

// Where pixels go, by their bytes. Any thread.
using PixelRoom = std::function<KeptBytes(size_t)>;

// Fills width, height, pixels and mips of `image`: grey and palette become RGB, no alpha becomes
// 255, 16 bits become 8. Returns a warning or "". Throws Unusable, naming `user`, where the data is
// broken. Any thread.
std::string decodeImage(std::span<const std::byte> file,
                        const std::string& user,
                        scene::Image& image,
                        const PixelRoom& room);

} // namespace froxel::gltf
