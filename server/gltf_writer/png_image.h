// Images of a scene as PNG bytes.
#pragma once

#include "core/error.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace froxel::gltf_writer {

// 8-bit RGB where every pixel is opaque, else RGBA; without colour-space chunks, which glTF tells
// readers to ignore. Errors: kScene for an image without pixels or of the wrong size.
[[nodiscard]] Result<std::vector<std::byte>> pngImage(const scene::Image& image);

} // namespace froxel::gltf_writer
