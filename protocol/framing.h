// How messages lie in WebSocket messages. Every binary message from the server starts with four
// bytes: magic, kind, and the length of a frame's or a mesh's header as u16 little endian.
//
//   frame           0xF7 0x01 length  FrameHeader[length] encoded bytes...
//   server message  0xF7 0x02 0x0000  ServerMessage...
//   depth           0xF7 0x03 length  DepthMeshHeader[length] coded mesh... (depth_mesh.h)
//
// A client's binary message is a bare ClientMessage; text either way is canonical JSON.
// Pure functions; any thread.
#pragma once

#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace froxel::v1 {
class ClientMessage;
class DepthMeshHeader;
class FrameHeader;
class ServerMessage;
} // namespace froxel::v1

namespace froxel::protocol {

inline constexpr uint8_t kMagic = 0xF7;
inline constexpr size_t kPrefixBytes = 4;

enum class Kind : uint8_t { kFrame = 1, kServerMessage = 2, kDepth = 3 };

enum class WireFormat : uint8_t { kBinary, kText };

using ByteSpan = std::span<const std::byte>;

[[nodiscard]] inline ByteSpan bytesOf(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// Prefix and header of a frame; the encoded bytes follow it in the same WebSocket message, so
// that a socket can gather both without a copy. A header over kMaxFrameHeaderBytes is a bug.
[[nodiscard]] std::string encodeFramePrefix(const v1::FrameHeader& header);

// Fills `header` and returns the encoded bytes, a view into `message`. Errors: kInvalidArgument
// for a wrong magic, kind or length, or parts that are not contiguous from 0 to the end.
[[nodiscard]] Result<ByteSpan> decodeFrame(ByteSpan message, v1::FrameHeader& header);

// The same of a depth message, whose bytes decodeDepthMesh() reads.
[[nodiscard]] std::string encodeDepthPrefix(const v1::DepthMeshHeader& header);
[[nodiscard]] Result<ByteSpan> decodeDepth(ByteSpan message, v1::DepthMeshHeader& header);

// What a binary message from the server is.
[[nodiscard]] Result<Kind> binaryKind(ByteSpan message);

// A complete WebSocket payload: with prefix when binary, JSON when text.
[[nodiscard]] std::string encodeServerMessage(const v1::ServerMessage& message, WireFormat format);
// For clients written in C++ (the load tool, tests). Errors: kInvalidArgument.
[[nodiscard]] Result<void>
decodeServerMessage(ByteSpan payload, WireFormat format, v1::ServerMessage& message);
[[nodiscard]] std::string encodeClientMessage(const v1::ClientMessage& message, WireFormat format);

} // namespace froxel::protocol
