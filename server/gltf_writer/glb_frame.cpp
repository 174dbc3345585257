#include "gltf_writer/glb_frame.h"

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>

namespace froxel::gltf_writer {

Result<GlbFrame> glbFrame(std::string json, size_t buffer_bytes) {
    constexpr uint32_t kMagic = 0x46546C67;     // "glTF"
    constexpr uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
    constexpr uint32_t kBinChunk = 0x004E4942;  // "BIN"
    const auto padded = [](size_t size) { return (size + 3) / 4 * 4; };
    json.resize(padded(json.size()), ' ');
    GlbFrame frame;
    frame.total_bytes = 12 + 8 + json.size() + (buffer_bytes != 0 ? 8 + padded(buffer_bytes) : 0);
    if (frame.total_bytes > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::kScene, "takes " + std::to_string(frame.total_bytes) +
                                            " bytes; a GLB file holds at most 4294967295"};
    }
    const auto add = [&](std::span<const std::byte> bytes) {
        frame.before.insert(frame.before.end(), bytes.begin(), bytes.end());
    };
    const auto addWords = [&](std::initializer_list<size_t> words) {
        for (const size_t word : words) {
            const auto narrow = static_cast<uint32_t>(word);
            add(std::as_bytes(std::span(&narrow, 1)));
        }
    };
    addWords({kMagic, 2, frame.total_bytes, json.size(), kJsonChunk});
    add(std::as_bytes(std::span(json)));
    if (buffer_bytes != 0) {
        addWords({padded(buffer_bytes), kBinChunk});
    }
    return frame;
}

} // namespace froxel::gltf_writer
