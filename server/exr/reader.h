// OpenEXR files to linear radiance. The files may come from anywhere: sizes are judged by the
// header, before pixels are allocated, and the library's exceptions don't leave a call.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace froxel::exr {

struct Picture {
    LinearImage image;                 // values as in the file, NaN and infinity included
    std::vector<std::string> warnings; // what was not applied: one line each
};

// By the first bytes.
[[nodiscard]] bool isExr(std::span<const std::byte> file);

// Whether a picture of so many pixels, at least 1x1, is wanted; called before pixels are allocated.
using SizeCheck = std::function<Result<void>(int64_t width_px, int64_t height_px)>;

// Channels R, G and B, or Y alone, of half or float; scan lines or tiles, of any compression; other
// channels are not read. Errors, none of which names the file: kIo where it is broken, kUnsupported
// for a layout that is not read, kCapacity for too many channels, those of `check`. Throws
// std::bad_alloc. Any thread.
[[nodiscard]] Result<Picture> read(std::span<const std::byte> file, const SizeCheck& check);

} // namespace froxel::exr
