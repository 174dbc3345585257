// What encoding a viewer's pictures takes of the host's memory. Pure.
#pragma once

#include "settings/settings.h"

#include <cstdint>

namespace froxel::encode {

// Upper bound, in bytes, of what is kept from picture to picture (settings::EncoderMemory) and of
// pictures on their way.
[[nodiscard]] uint64_t memoryBytes(const settings::Encoding& encoding, const settings::Size& size);

} // namespace froxel::encode
