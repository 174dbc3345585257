// Pictures to files. The format follows from the file's name: .png, .jpg or .jpeg, .pfm.
#pragma once

#include "core/error.h"
#include "core/pixel_view.h"
#include "settings/settings.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace froxel::encode {

enum class ImageFormat : uint8_t { kPng, kJpeg, kPfm };

// Errors: kInvalidArgument naming the file and the extensions that work.
[[nodiscard]] Result<ImageFormat> imageFormatOf(const std::filesystem::path& path);

// .png (8-bit RGB, sRGB) or .jpg (with `encoding`). Errors: kInvalidArgument for another format
// or an empty view, kIo; both name the file. A file that could not be completed is removed.
[[nodiscard]] Result<void> writeImage(const std::filesystem::path& path,
                                      const PixelView& pixels,
                                      const settings::Encoding& encoding);

// .pfm: linear fp32, `rgb` is [height][width][3], top row first (the file holds rows bottom-up,
// little endian, bit for bit). Errors as above.
[[nodiscard]] Result<void> writePfm(const std::filesystem::path& path,
                                    uint32_t width_px,
                                    uint32_t height_px,
                                    std::span<const float> rgb);

} // namespace froxel::encode
