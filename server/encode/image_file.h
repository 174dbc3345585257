// Pictures to files. The format follows from the file's name: .png, .jpg or .jpeg, .exr, .pfm.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"
#include "core/outputs.h"
#include "core/pixel_view.h"
#include "settings/settings.h"

#include <cstdint>
#include <filesystem>

namespace froxel::encode {

enum class ImageFormat : uint8_t { kPng, kJpeg, kExr, kPfm };

// What it holds in place of display colours: light itself, as floats; none: it holds these.
[[nodiscard]] constexpr Outputs outputsOf(ImageFormat format) {
    return format == ImageFormat::kExr   ? settings::rowOf(settings::Codec::kExr).outputs
           : format == ImageFormat::kPfm ? settings::rowOf(settings::Codec::kPfm).outputs
                                         : Outputs{};
}

// Errors: kInvalidArgument naming the file and the extensions that work.
[[nodiscard]] Result<ImageFormat> imageFormatOf(const std::filesystem::path& path);

// .png (8-bit RGB, sRGB) or .jpg (with `encoding`). Errors: kInvalidArgument for another format
// or an empty view, kIo; both name the file. A file that could not be completed is removed.
[[nodiscard]] Result<void> writeImage(const std::filesystem::path& path,
                                      const PixelView& pixels,
                                      const settings::Encoding& encoding);

// .exr or .pfm (encode/radiance_encoder.h). Errors as above.
[[nodiscard]] Result<void> writeRadiance(const std::filesystem::path& path,
                                         const LinearImage& image);

} // namespace froxel::encode
