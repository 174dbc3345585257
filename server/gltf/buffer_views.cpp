#include "gltf/buffer_views.h"

#include "gltf/meshopt_view.h"

namespace froxel::gltf {

BufferViews::BufferViews(const Document& document,
                         SceneFiles& files,
                         LoadProgress& progress,
                         ReadMemory& memory)
    : document_(document), files_(files), progress_(progress), buffers_(document.buffers.size()),
      decoded_bytes_("bytes of decompressed buffer views", kMaxDecodedViewBytes, 1, memory) {}

std::span<const std::byte> BufferViews::bufferBytes(size_t buffer) {
    const BufferSource& source = document_.buffers[buffer];
    const std::string user = thing("buffer", buffer);
    std::span<const std::byte> bytes;
    if (source.uri.empty()) {
        if (buffer != 0 || document_.binary_chunk.empty()) {
            fail(user + " has no URI and is not the binary chunk of a GLB file");
        }
        bytes = document_.binary_chunk;
    } else {
        std::optional<Bytes>& loaded = buffers_[buffer];
        if (!loaded) {
            loaded = files_.read(source.uri, user);
        }
        bytes = *loaded;
    }
    if (bytes.size() < source.size_bytes) {
        fail(user + " says " + std::to_string(source.size_bytes) + " bytes, but there are " +
             std::to_string(bytes.size()));
    }
    return bytes.first(source.size_bytes);
}

// Offsets and lengths are below 2^32 each (json_types), so their sum cannot wrap.
std::span<const std::byte>
BufferViews::range(int buffer, uint64_t offset, uint64_t length, const std::string& user) {
    const size_t index = checkedIndex(buffer, document_.buffers.size(), "buffer", user);
    const uint64_t size = document_.buffers[index].size_bytes;
    if (offset + length > size) {
        fail(user + " ends at byte " + std::to_string(offset + length) + ", but buffer " +
             std::to_string(index) + " has " + std::to_string(size) + " bytes");
    }
    return bufferBytes(index).subspan(offset, length);
}

std::span<const std::byte> BufferViews::bytes(int view, const std::string& user) {
    progress_.ask();
    const auto& views = document_.model.bufferViews;
    const size_t index = checkedIndex(view, views.size(), "bufferView", user);
    const std::string name = thing("bufferView", index);
    const tinygltf::BufferView& source = views[index];
    const std::optional<MeshoptView> compressed = meshoptView(source, name);
    if (!compressed) {
        return range(source.buffer, source.byteOffset, source.byteLength, name);
    }
    const auto known = decoded_views_.find(index);
    if (known != decoded_views_.end()) {
        return known->second;
    }
    const auto encoded =
        range(compressed->buffer, compressed->offset_bytes, compressed->size_bytes, name);
    checkRatio(*compressed, name);
    decoded_bytes_.take(compressed->decodedBytes(), name);
    return decoded_views_.emplace(index, decodeMeshopt(*compressed, encoded, name)).first->second;
}

size_t BufferViews::stride(int view) const {
    return document_.strides[static_cast<size_t>(view)];
}

} // namespace froxel::gltf
