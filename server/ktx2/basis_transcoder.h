// Basis Universal's transcoder, which npm's three carries as WebAssembly; wabt's wasm2c makes C of
// it while building. It runs in a memory of its own, whatever a file does to it.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <span>

namespace froxel::ktx2 {

// A KTX2 file of ETC1S or UASTC, which readContainer() has taken, into RGBA8: `levels` are the
// file's, each of exactly its size. Beside what it is given it needs two to three times the largest
// level for the time of the call. Errors: kIo where the transcoder takes the file for broken,
// kUnsupported in a build without it (FROXEL_BASIS). Any thread.
[[nodiscard]] Result<void> transcodeBasis(std::span<const std::byte> file,
                                          std::span<const std::span<std::byte>> levels);

} // namespace froxel::ktx2
