#include "gltf_writer/binary_buffer.h"

#include <bit>

namespace froxel::gltf_writer {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

// Values of the specification.
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr size_t kShortIndexLimit = 0xffff; // the largest index is the restart value, not allowed

} // namespace

uint32_t BinaryBuffer::addBytes(std::span<const std::byte> bytes) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return static_cast<uint32_t>(views_.size() - 1);
}

uint32_t
BinaryBuffer::addAccessor(uint32_t view, int component_type, size_t count, const char* type) {
    const bool indices = component_type != kFloat;
    views_[view]["target"] = indices ? kElementArrayBuffer : kArrayBuffer;
    accessors_.push_back({{"bufferView", view},
                          {"componentType", component_type},
                          {"count", count},
                          {"type", type}});
    return static_cast<uint32_t>(accessors_.size() - 1);
}

uint32_t BinaryBuffer::addIndices(std::span<const uint32_t> indices, size_t vertex_count) {
    if (vertex_count <= kShortIndexLimit) {
        const std::vector<uint16_t> narrow(indices.begin(), indices.end());
        return addAccessor(addBytes(std::as_bytes(std::span(narrow))), kUnsignedShort,
                           narrow.size(), "SCALAR");
    }
    return addAccessor(addBytes(std::as_bytes(indices)), kUnsignedInt, indices.size(), "SCALAR");
}

uint32_t BinaryBuffer::addVectors(std::span<const glm::vec2> values) {
    return addAccessor(addBytes(std::as_bytes(values)), kFloat, values.size(), "VEC2");
}

uint32_t BinaryBuffer::addVectors(std::span<const glm::vec3> values, bool with_bounds) {
    const uint32_t accessor =
        addAccessor(addBytes(std::as_bytes(values)), kFloat, values.size(), "VEC3");
    if (with_bounds) {
        Bounds3 bounds;
        for (const glm::vec3& value : values) {
            bounds.add(value);
        }
        accessors_[accessor]["min"] = {bounds.min.x, bounds.min.y, bounds.min.z};
        accessors_[accessor]["max"] = {bounds.max.x, bounds.max.y, bounds.max.z};
    }
    return accessor;
}

uint32_t BinaryBuffer::addVectors(std::span<const glm::vec4> values) {
    return addAccessor(addBytes(std::as_bytes(values)), kFloat, values.size(), "VEC4");
}

} // namespace froxel::gltf_writer
