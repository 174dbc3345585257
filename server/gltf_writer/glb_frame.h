// What stands around the one buffer of a GLB (glTF 2.0, 4.4).
#pragma once

#include "core/error.h"

#include <cstddef>
#include <string>
#include <vector>

namespace froxel::gltf_writer {

struct GlbFrame {
    std::vector<std::byte> before; // the header, the JSON chunk, the header of the buffer's chunk
    size_t total_bytes = 0;        // with the buffer, and zeros behind it up to this
};

// Errors: kScene where the file would have more than 4 GiB.
[[nodiscard]] Result<GlbFrame> glbFrame(std::string json, size_t buffer_bytes);

} // namespace froxel::gltf_writer
