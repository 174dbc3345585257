// The frame of a binary STL file: 80 bytes of anything, the number of triangles, the triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace froxel::binary_stl {

inline constexpr size_t kHeaderBytes = 84;
inline constexpr size_t kTriangleBytes = 50;

// As the header says; `begin` has at least that.
[[nodiscard]] inline uint32_t triangleCount(std::span<const std::byte> begin) {
    uint32_t count = 0;
    std::memcpy(&count, begin.data() + kHeaderBytes - sizeof count, sizeof count);
    return count;
}

// Of the whole file. The format has no mark: one of just so many bytes is one.
[[nodiscard]] inline uint64_t sizeBytes(std::span<const std::byte> begin) {
    return kHeaderBytes + uint64_t{triangleCount(begin)} * kTriangleBytes;
}

} // namespace froxel::binary_stl
