// KTX2 files to RGBA8: ETC1S, UASTC, and 8 bits a channel, by Zstandard, zlib and Basis Universal's
// own transcoder. The files may come from anywhere: what is allocated is bounded by the sizes that
// the caller has chosen to take.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace froxel::ktx2 {

struct Size {
    uint32_t width_px = 0; // of the largest level; the next has half, rounded down, but at least 1
    uint32_t height_px = 0;
    uint32_t level_count = 1;
};

// By the signature alone.
[[nodiscard]] bool isKtx2(std::span<const std::byte> file);

// By header, level index and data format descriptor. Errors: kUnsupported for what is no single
// flat picture or has other texels, kIo for a broken file. Any thread.
[[nodiscard]] Result<Size> readSize(std::span<const std::byte> file);

// Each level [height][width][4], top row first; no alpha becomes 255. `levels` are the file's, each
// of exactly its size; where the file is broken, some may be written. Errors: those of readSize(),
// kInvalidArgument for other sizes. Any thread.
[[nodiscard]] Result<void> readPixels(std::span<const std::byte> file,
                                      std::span<const std::span<std::byte>> levels);

} // namespace froxel::ktx2
