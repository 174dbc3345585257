#include "gltf_writer/png_image.h"

#include "png/writer.h"

#include <string>

namespace froxel::gltf_writer {
namespace {

constexpr size_t kChannels = 4;

bool isOpaque(const scene::Image& image) {
    for (size_t i = 3; i < image.rgba8.size(); i += kChannels) {
        if (image.rgba8[i] != std::byte{255}) {
            return false;
        }
    }
    return true;
}

} // namespace

Result<std::vector<std::byte>> pngImage(const scene::Image& image) {
    const size_t row_bytes = size_t{image.width_px} * kChannels;
    const size_t expected = row_bytes * image.height_px;
    if (expected == 0 || image.rgba8.size() != expected) {
        return Error{ErrorCode::kScene,
                     "image '" + image.name + "' has " + std::to_string(image.rgba8.size()) +
                         " bytes; " + std::to_string(image.width_px) + "x" +
                         std::to_string(image.height_px) + " RGBA8 pixels need " +
                         std::to_string(expected) + ", more than 0"};
    }
    const auto channels = isOpaque(image) ? png::Channels::kRgb : png::Channels::kRgba;
    auto file = png::write({image.rgba8.data(), image.width_px, image.height_px, row_bytes},
                           {channels, png::Compression::kDefault, false});
    if (!file) {
        return Error{ErrorCode::kScene, "image '" + image.name +
                                            "' cannot be encoded as PNG: " + file.error().message};
    }
    return file;
}

} // namespace froxel::gltf_writer
