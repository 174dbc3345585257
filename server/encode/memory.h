// What encoding a viewer's pictures takes of the host's memory. Pure.
#pragma once

#include "view/settings.h"

#include <cstdint>

namespace froxel::encode {

// Upper bound, in bytes, of what is kept from picture to picture (view::EncoderMemory) and of
// pictures on their way.
[[nodiscard]] uint64_t memoryBytes(const view::Encoding& encoding, const view::Size& size);

} // namespace froxel::encode
