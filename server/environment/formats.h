// The file formats of panoramas. Errors and warnings do not name the file; reader.cpp does.
#pragma once

#include "environment/reader.h"

namespace froxel::environment {

// Checked before pixels are allocated.
[[nodiscard]] Result<void> checkSize(int64_t width_px, int64_t height_px);

[[nodiscard]] bool isRadiance(std::span<const std::byte> file);
[[nodiscard]] Result<Panorama> readRadiance(std::span<const std::byte> file);

} // namespace froxel::environment
