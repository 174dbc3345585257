// The container of a KTX2 file (Khronos KTX File Format Specification, version 2): what its texels
// are and where its levels lie.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::ktx2 {

enum class Texels : uint8_t { kRgb8, kRgba8, kEtc1s, kUastc };
enum class Packing : uint8_t { kNone, kBasisLz, kZstandard, kZlib }; // the file's numbers

struct Level {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::span<const std::byte> packed; // in the file
};

struct Container {
    Texels texels = Texels::kRgba8;
    Packing packing = Packing::kNone;
    std::vector<Level> levels; // the largest first; at least one
};

// Bytes of a level when it is unpacked; not of kEtc1s, whose blocks vary.
[[nodiscard]] uint64_t unpackedBytes(Texels texels, const Level& level);

// Reads header, level index and data format descriptor, and checks all that they say. Sides are 1
// to 2^30. Errors: kUnsupported for a valid file of another kind (a cube, other texels), kIo for
// a broken one. Any thread.
[[nodiscard]] Result<Container> readContainer(std::span<const std::byte> file);

} // namespace froxel::ktx2
