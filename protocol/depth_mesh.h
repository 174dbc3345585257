// The code of a depth mesh (core/depth_mesh.h) in a message of its kind; README.md has a worked
// example. Pure functions; any thread.
//
// Inverse distances are even steps from 0 to that of the nearest vertex. Each is told by what it
// differs from left + above - above left, which is nothing along a plane; differences go in runs,
// in nibbles of three bits and one that says whether more follow (after Wilson 2017, "Fast Lossless
// Depth Image Compression").
#pragma once

#include "core/depth_mesh.h"
#include "core/error.h"
#include "protocol/framing.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::protocol {

inline constexpr uint32_t kMinDepthBits = 6;
inline constexpr uint32_t kMaxDepthBits = 12;

struct CodedDepthMesh {
    DepthMeshSize size;
    uint32_t cell_px = kDepthCell_px; // from one vertex to the next
    uint32_t bits = 0;                // of a step's number
    double nearest_per_m = 0;         // inverse distance of the last step; 0: nothing is there
    std::vector<std::byte> bytes{};

    bool operator==(const CodedDepthMesh&) const = default;
};

// `inverse_distances`: by row, in 1/m; what is not finite or not positive is nowhere.
[[nodiscard]] CodedDepthMesh
encodeDepthMesh(std::span<const float> inverse_distances, DepthMeshSize size, uint32_t bits);

// The steps' numbers, by row. Errors: kInvalidArgument for anything that encodeDepthMesh() does
// not make.
[[nodiscard]] Result<std::vector<uint16_t>>
decodeDepthMesh(ByteSpan bytes, DepthMeshSize size, uint32_t bits);

} // namespace froxel::protocol
