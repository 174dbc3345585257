// Meshlets and detail levels on disk: to make them takes most of the time that a large scene takes
// to load. A file is named by the hash of all that it was made of: the meshes, the options, and the
// code that makes it. What is damaged or of another hash is made anew.
#pragma once

#include "core/error.h"
#include "render/scene/geometry_pack.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace froxel::render {

// A folder's files of this kind take no more; those that were used longest ago go first.
inline constexpr uint64_t kMostCachedBytes = uint64_t{4} << 30U;

using GeometryHash = std::array<std::byte, 32>; // SHA-256

// Of all that packing makes triangles of. On as many threads as pay.
[[nodiscard]] GeometryHash hashOfGeometry(const scene::Scene& scene, const PackOptions& options);

[[nodiscard]] std::filesystem::path geometryCacheFile(const std::filesystem::path& folder,
                                                      const GeometryHash& hash);

// Fills in triangles, details and the primitives' ranges of them, as packing would. False: the file
// is not there, or is not believed, which is logged; then `out` is as it was.
[[nodiscard]] bool readGeometry(const std::filesystem::path& file,
                                const GeometryHash& hash,
                                const scene::Scene& scene,
                                PackedGeometry& out);

// Replaces the file at once, and removes others beside it that are too much (kMostCachedBytes).
// Errors: kIo, also where it would be too large itself.
[[nodiscard]] Result<void> writeGeometry(const std::filesystem::path& file,
                                         const GeometryHash& hash,
                                         const PackedGeometry& packed,
                                         uint64_t most_bytes = kMostCachedBytes);

} // namespace froxel::render
