// The frame of a .glb file: header, JSON chunk, optional binary chunk.
#pragma once

#include "gltf/warnings.h"

#include <cstddef>
#include <span>

namespace froxel::gltf {

struct GlbChunks {
    std::span<const std::byte> json;
    std::span<const std::byte> binary; // empty where the file has none
};

[[nodiscard]] bool isGlb(std::span<const std::byte> file);

// Both chunks lie inside `file`. Throws Failure on a header or chunk that does not fit; where the
// header tells another length than the file's, chunks that fit are taken with a warning.
// Checked here and not by tinygltf, whose check forgets the binary chunk's own header.
[[nodiscard]] GlbChunks splitGlb(std::span<const std::byte> file, Warnings& warnings);

} // namespace froxel::gltf
