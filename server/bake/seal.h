// Shared memory that nobody can change any more.
#pragma once

#include <chrono>

namespace froxel::bake {

// Seals a memfd against all writing. A process that has ended may still have it mapped for a
// moment: whoever reads /proc about that process keeps its memory. Waits for that, at most so long.
// False: errno says why not.
[[nodiscard]] bool seal(int descriptor,
                        std::chrono::milliseconds patience = std::chrono::seconds(10));

} // namespace froxel::bake
