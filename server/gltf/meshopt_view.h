// EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose bytes are compressed by
// meshoptimizer.
#pragma once

#include "gltf/bytes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tinygltf {
struct BufferView;
} // namespace tinygltf

namespace froxel::gltf {

enum class MeshoptMode { kAttributes, kTriangles, kIndices };
enum class MeshoptFilter { kNone, kOctahedral, kQuaternion, kExponential };

struct MeshoptView {
    int buffer = -1;
    uint64_t offset_bytes = 0;
    uint64_t size_bytes = 0; // compressed
    size_t stride_bytes = 0;
    size_t count = 0;
    MeshoptMode mode = MeshoptMode::kAttributes;
    MeshoptFilter filter = MeshoptFilter::kNone;

    [[nodiscard]] uint64_t decodedBytes() const { return uint64_t{count} * stride_bytes; }
};

// nullopt where the view is not compressed. Throws Failure where the extension's values are not
// what its specification allows.
[[nodiscard]] std::optional<MeshoptView> meshoptView(const tinygltf::BufferView& view,
                                                     const std::string& name);

// Throws Failure where so few compressed bytes cannot hold what the view says.
void checkRatio(const MeshoptView& view, const std::string& name);

// Throws Failure where the stream is not valid. Decoded indices may still be out of range.
[[nodiscard]] Bytes
decodeMeshopt(const MeshoptView& view, std::span<const std::byte> encoded, const std::string& name);

} // namespace froxel::gltf
