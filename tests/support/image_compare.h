// Reading and comparing PNG pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace froxel::test {

struct RgbImage {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<std::byte> rgb8; // [height][width][3]
};

// None where the file is absent or is not a PNG.
[[nodiscard]] std::optional<RgbImage> readPng(const std::filesystem::path& path);

struct ImageDifference {
    double rmse = 0;          // of 8-bit values
    double rmse_up_to_8 = 0;  // the same without pixels that have a channel more than 8/255 off
    double share_above_8 = 0; // of those pixels
};

// Sizes must be equal; `rgba8` has alpha, which is ignored.
[[nodiscard]] ImageDifference compare(const RgbImage& golden, const std::vector<std::byte>& rgba8);

} // namespace froxel::test
