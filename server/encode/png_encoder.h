// Lossless pictures, as PNG files.
#pragma once

#include "encode/encoder.h"

#include <cstddef>
#include <memory>

namespace froxel::encode {

[[nodiscard]] std::unique_ptr<Encoder> makePngEncoder(size_t thread_count);

} // namespace froxel::encode
