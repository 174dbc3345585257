// What this build's compiled pipelines depend on.
#pragma once

#include <cstdint>

namespace froxel::render {

// Of all embedded SPIR-V: another build, another hash.
[[nodiscard]] uint64_t hashOfShaders();

} // namespace froxel::render
