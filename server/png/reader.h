// PNG files to RGBA8 by libpng. The files may come from anywhere: what is allocated is bounded by
// the caller's choice of sizes, and no exception and no longjmp of libpng leaves a call.
#pragma once

#include "core/error.h"
#include "core/picture_size.h"

#include <cstddef>
#include <span>

namespace froxel::png {

// By the signature alone.
[[nodiscard]] bool isPng(std::span<const std::byte> file);

struct Header {
    PictureSize size;              // sides are 1 to 2^31 - 1
    uint32_t bits_per_channel = 8; // 1, 2, 4, 8 or 16
};

// Errors: kIo with libpng's reason, where it is broken. Any thread.
[[nodiscard]] Result<Header> readHeader(std::span<const std::byte> file);
[[nodiscard]] Result<PictureSize> readSize(std::span<const std::byte> file);

// [height][width][4], top row first: grey and palette become RGB, no alpha becomes 255, 16 bits
// become 8; colour profiles and gamma are ignored. `rgba8` has exactly the file's size; where the
// file is broken, rows of it may be written. Errors: kInvalidArgument for another size, kIo with
// libpng's reason. Any thread.
[[nodiscard]] Result<void> readPixels(std::span<const std::byte> file, std::span<std::byte> rgba8);

} // namespace froxel::png
