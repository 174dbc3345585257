#include "gltf/glb_container.h"

#include "gltf/failure.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace froxel::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB words are little-endian");

constexpr size_t kHeaderBytes = 12;
constexpr size_t kChunkHeaderBytes = 8;
constexpr uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kJson = 0x4E4F534A;   // "JSON"
constexpr uint32_t kBinary = 0x004E4942; // "BIN\0"

uint32_t word(std::span<const std::byte> file, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, file.data() + offset, sizeof value);
    return value;
}

// Whether the binary chunk comes at `offset`. Chunks of other types are for others: the
// specification has them ignored. What is cut off inside the length that the header tells was one.
bool beginsBinary(std::span<const std::byte> file, size_t offset, size_t told_length) {
    const size_t left = file.size() - offset;
    return left >= kChunkHeaderBytes ? word(file, offset + 4) == kBinary
                                     : left > 0 && offset < told_length;
}

// The chunk at `offset`; moves `offset` behind it.
std::span<const std::byte>
chunk(std::span<const std::byte> file, size_t& offset, uint32_t type, const char* name) {
    const size_t left = file.size() - offset;
    if (left < kChunkHeaderBytes) {
        fail(std::string("the ") + name + " chunk's header is cut off: " + std::to_string(left) +
             " bytes are left, 8 are needed");
    }
    const uint32_t length = word(file, offset);
    if (word(file, offset + 4) != type) {
        fail(std::string("the chunk at byte ") + std::to_string(offset) + " is not of type " +
             name);
    }
    if (length > left - kChunkHeaderBytes) {
        fail(std::string("the ") + name + " chunk says " + std::to_string(length) + " bytes, but " +
             std::to_string(left - kChunkHeaderBytes) + " are left in the file");
    }
    const auto bytes = file.subspan(offset + kChunkHeaderBytes, length);
    offset += kChunkHeaderBytes + length;
    return bytes;
}

} // namespace

bool isGlb(std::span<const std::byte> file) {
    return file.size() >= sizeof kMagic && word(file, 0) == kMagic;
}

GlbChunks splitGlb(std::span<const std::byte> file, Warnings& warnings) {
    if (file.size() < kHeaderBytes) {
        fail("the GLB header is cut off: " + std::to_string(file.size()) + " bytes, 12 are needed");
    }
    const uint32_t version = word(file, 4);
    if (version == 1) {
        failOldVersion("its GLB version is 1");
    }
    if (version != 2) {
        fail("the GLB version is " + std::to_string(version) + "; 2 is supported");
    }
    const uint32_t length = word(file, 8);
    if (length != file.size()) {
        warnings.add(warning::kGlbLength, "",
                     "the GLB header says " + std::to_string(length) + " bytes, but the file has " +
                         std::to_string(file.size()));
    }
    size_t offset = kHeaderBytes;
    GlbChunks chunks;
    chunks.json = chunk(file, offset, kJson, "JSON");
    if (beginsBinary(file, offset, length)) {
        chunks.binary = chunk(file, offset, kBinary, "BIN");
    }
    return chunks;
}

} // namespace froxel::gltf
