// The bytes behind buffer views: buffers are read, and compressed views decoded, when first used.
#pragma once

#include "gltf/document.h"
#include "gltf/limits.h"
#include "gltf/load_progress.h"
#include "gltf/scene_files.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace froxel::gltf {

// Not thread-safe. Spans live as long as this does.
class BufferViews {
  public:
    BufferViews(const Document& document,
                SceneFiles& files,
                LoadProgress& progress,
                ReadMemory& memory);

    // The whole view, checked to lie inside its buffer. Throws Failure, naming `user`;
    // CalledOff, since all that is long to read begins here.
    [[nodiscard]] std::span<const std::byte> bytes(int view, const std::string& user);

    // Bytes from one element to the next; 0: tightly packed.
    [[nodiscard]] size_t stride(int view) const;

  private:
    [[nodiscard]] std::span<const std::byte>
    range(int buffer, uint64_t offset, uint64_t length, const std::string& user);
    [[nodiscard]] std::span<const std::byte> bufferBytes(size_t buffer);

    const Document& document_;
    SceneFiles& files_;
    LoadProgress& progress_;
    std::vector<std::optional<Bytes>> buffers_; // what came from a file or a data: URI
    std::map<size_t, Bytes> decoded_views_;
    Budget decoded_bytes_;
};

} // namespace froxel::gltf
