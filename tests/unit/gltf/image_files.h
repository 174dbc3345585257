// Image files made in memory, and how text holds them.
#pragma once

#include "unit/gltf/scene_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace froxel::gltf::test {

// An image of one colour; grey where `grey`.
[[nodiscard]] Bytes jpegFile(uint32_t side_px, uint8_t red, uint8_t green, uint8_t blue, bool grey);

// Lossless, of [row][column][4] with `side_px` columns.
[[nodiscard]] Bytes webpFile(const std::vector<uint8_t>& rgba, uint32_t side_px);

[[nodiscard]] std::string base64(const Bytes& bytes);

} // namespace froxel::gltf::test
