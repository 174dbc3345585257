// Pictures to compare, from files. The files may come from anywhere.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"
#include "core/packed_pixels.h"
#include "core/picture_size.h"
#include "core/pixel_view.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace froxel::diff {

// Display colours (sRGB, 8 bits): of PNG and JPEG.
struct ShownPicture {
    PictureSize size;
    std::vector<std::byte> rgba8; // [height][width][4], top row first

    [[nodiscard]] PixelView view() const {
        return packedView(rgba8, size.width_px, size.height_px);
    }
};

// Or linear radiance: of OpenEXR and PFM.
using Picture = std::variant<ShownPicture, LinearImage>;

[[nodiscard]] inline PictureSize sizeOf(const Picture& picture) {
    if (const auto* shown = std::get_if<ShownPicture>(&picture)) {
        return shown->size;
    }
    const auto& light = std::get<LinearImage>(picture);
    return {light.width_px, light.height_px};
}

// Of a file that is not larger than this.
inline constexpr uint64_t kMaxFileBytes = uint64_t{1} << 30;
// About 70 bytes a pixel are needed for two pictures and their FLIP. A fuzzer would find nothing
// but this limit.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr uint64_t kMaxPixels = uint64_t{256} * 256;
#else
inline constexpr uint64_t kMaxPixels = uint64_t{7680} * 4320;
#endif

struct PictureFile {
    Picture picture;
    std::vector<std::string> warnings; // what is not compared, one line each; they name the file
};

// PNG, JPEG, OpenEXR or PFM, by the first bytes. Errors, which name `name`: kIo where it is broken,
// kUnsupported for another format or layout, kCapacity for too many pixels. Throws std::bad_alloc.
// Any thread.
[[nodiscard]] Result<PictureFile> decode(std::span<const std::byte> file, const std::string& name);

// Likewise; kIo, too, where it cannot be read.
[[nodiscard]] Result<PictureFile> read(const std::filesystem::path& path);

} // namespace froxel::diff
