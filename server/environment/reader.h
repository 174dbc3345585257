// Panoramas from files: Radiance's RGBE (.hdr) and OpenEXR (.exr). The files may come from
// anywhere: sizes are judged by the header, before pixels are allocated, and no exception leaves a
// call.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace froxel::environment {

// A panorama is twice as wide as high: at most 400 MB of pixels. A fuzzer would find nothing but
// this limit.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr uint32_t kMaxPanoramaWidth_px = 256;
#else
inline constexpr uint32_t kMaxPanoramaWidth_px = 8192;
#endif
// What half floats hold at most; an infinite value is read as this.
inline constexpr float kInfiniteRadiance = 65504;

struct Panorama {
    LinearImage image;                 // finite, not negative
    std::vector<std::string> warnings; // what was read as something else: one line each
};

// By the first bytes. Radiance is linear with Rec. 709's primaries. Values that no light has are
// replaced: NaN and below 0 by 0, infinity by kInfiniteRadiance; a warning counts them. Errors,
// which name `user`: kIo where the file is broken, kUnsupported for a layout that is not read,
// kCapacity for too many pixels, kInvalidArgument for another shape. Any thread.
[[nodiscard]] Result<Panorama> read(std::span<const std::byte> file, const std::string& user);

} // namespace froxel::environment
