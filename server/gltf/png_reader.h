// libpng behind a plain call; no exception and no longjmp leaves it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace froxel::gltf {

[[nodiscard]] bool isPng(std::span<const std::byte> file);

// False, with libpng's reason, where the header is broken.
[[nodiscard]] bool readPngSize(std::span<const std::byte> file,
                               uint32_t& width_px,
                               uint32_t& height_px,
                               std::string& reason);

// RGBA8 rows, top first; `pixels` has exactly the file's width * height * 4 bytes.
// False, with libpng's reason, where the file is broken.
[[nodiscard]] bool
readPngPixels(std::span<const std::byte> file, std::span<std::byte> pixels, std::string& reason);

} // namespace froxel::gltf
