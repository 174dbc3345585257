// Small pictures and the bytes of their files.
#pragma once

#include "diff/picture.h"

#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace froxel::diff {

inline std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

inline std::string floatsOf(std::initializer_list<float> values) {
    std::string text;
    for (const float value : values) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        text.append(bytes, sizeof bytes);
    }
    return text;
}

// Every pixel of one grey.
inline ShownPicture shown(uint32_t width_px, uint32_t height_px, uint8_t grey) {
    ShownPicture picture{{width_px, height_px}, {}};
    for (uint64_t i = 0; i < picture.size.pixelCount(); ++i) {
        picture.rgba8.insert(picture.rgba8.end(), 3, std::byte{grey});
        picture.rgba8.push_back(std::byte{255});
    }
    return picture;
}

inline LinearImage light(uint32_t width_px, uint32_t height_px, float value) {
    return {width_px, height_px, std::vector<float>(size_t{3} * width_px * height_px, value)};
}

} // namespace froxel::diff
