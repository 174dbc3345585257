// JPEG files to RGBA8 by libjpeg-turbo. The files may come from anywhere: what is allocated is
// bounded by the caller's choice of sizes, and a file with too many scans is refused.
#pragma once

#include "core/error.h"
#include "core/picture_size.h"

#include <cstddef>
#include <span>
#include <string>

namespace froxel::jpeg {

// By the first bytes alone.
[[nodiscard]] bool isJpeg(std::span<const std::byte> file);

// By the header alone; sides are at least 1. Errors: kIo with the library's reason where it is
// broken, kUnsupported for CMYK. Any thread.
[[nodiscard]] Result<PictureSize> readSize(std::span<const std::byte> file);

// [height][width][4], top row first, alpha 255. `rgba8` has exactly the file's size. Returns what
// is wrong with a file that can be shown nevertheless, else "". Errors: those of readSize(),
// kInvalidArgument for another size. Any thread.
[[nodiscard]] Result<std::string> readPixels(std::span<const std::byte> file,
                                             std::span<std::byte> rgba8);

} // namespace froxel::jpeg
