// RGBA8 pixels to PNG files of 8 bits a channel, by libpng, without loss.
#pragma once

#include "core/error.h"
#include "core/pixel_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel::png {

enum class Channels : uint8_t { kRgb, kRgba };

enum class Compression : uint8_t {
    // Paeth's filter and run lengths alone: of the built-in hall, on one core of a shared Xeon,
    // 640x360 takes 11 ms and 351 kB, 1280x720 41 ms and 1,178 kB. zlib's default takes 60 and 242
    // ms for 361 and 1,208 kB, WebP's fastest lossless method 12 and 52 ms for 337 and 1,122 kB.
    kFast,
    kDefault, // libpng's
};

// As of a picture for the screen.
struct WriteOptions {
    Channels channels = Channels::kRgb; // kRgb: the fourth bytes are left out
    Compression compression = Compression::kFast;
    bool srgb = true; // the file says so; without, it says nothing of its colours
};

// The pixels need be neither sRGB nor opaque. Errors: kInvalidArgument for an empty or inconsistent
// view, kIo with libpng's text. Any thread.
[[nodiscard]] Result<std::vector<std::byte>> write(const PixelView& pixels,
                                                   const WriteOptions& options = {});

} // namespace froxel::png
