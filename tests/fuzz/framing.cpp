// A message from a server, as clients in C++ read it: a frame, or a ServerMessage in both formats.
#include "protocol/framing.h"

#include "core/assert.h"
#include "froxel/v1/server.pb.h"
#include "fuzz/target.h"
#include "protocol/depth_mesh.h"
#include "protocol/limits.h"

#include <google/protobuf/stubs/logging.h>

#include <algorithm>

namespace froxel::fuzz {
namespace {

using protocol::ByteSpan;
using protocol::WireFormat;

void readFrame(ByteSpan bytes) {
    v1::FrameHeader header;
    const auto payload = protocol::decodeFrame(bytes, header);
    if (!payload) {
        FROXEL_ASSERT(isOneLine(payload.error().message), "a refusal is one line");
        return;
    }
    // Encoded anew a header may be a few bytes longer, or, of default values alone, empty.
    if (header.ByteSizeLong() == 0 || header.ByteSizeLong() > protocol::kMaxFrameHeaderBytes) {
        return;
    }
    std::string again = protocol::encodeFramePrefix(header);
    again.append(reinterpret_cast<const char*>(payload->data()), payload->size());
    v1::FrameHeader header_again;
    const auto payload_again = protocol::decodeFrame(protocol::bytesOf(again), header_again);
    FROXEL_ASSERT(payload_again && std::ranges::equal(*payload, *payload_again),
                  "a frame that was read can be written");
    FROXEL_ASSERT(header.SerializeAsString() == header_again.SerializeAsString(),
                  "its header reads back the same");
}

void readDepth(ByteSpan bytes) {
    v1::DepthMeshHeader header;
    const auto coded = protocol::decodeDepth(bytes, header);
    if (!coded) {
        FROXEL_ASSERT(isOneLine(coded.error().message), "a refusal is one line");
        return;
    }
    constexpr uint32_t kMostSide_px = 512;
    DepthMeshSize size(1 + header.columns() % kMostSide_px, 1 + header.rows() % kMostSide_px);
    const auto steps = protocol::decodeDepthMesh(*coded, size, header.bits());
    FROXEL_ASSERT(steps ? steps->size() == size.vertexCount() : isOneLine(steps.error().message),
                  "a step for each vertex, or one line");
}

void readServerMessage(ByteSpan bytes, WireFormat format) {
    v1::ServerMessage message;
    if (const auto read = protocol::decodeServerMessage(bytes, format, message); !read) {
        FROXEL_ASSERT(isOneLine(read.error().message), "a refusal is one line");
        return;
    }
    v1::ServerMessage again;
    const std::string written = protocol::encodeServerMessage(message, WireFormat::kBinary);
    const auto read =
        protocol::decodeServerMessage(protocol::bytesOf(written), WireFormat::kBinary, again);
    FROXEL_ASSERT(read && message.SerializeAsString() == again.SerializeAsString(),
                  "a message that was read reads back the same");
}

} // namespace
} // namespace froxel::fuzz

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const google::protobuf::LogSilencer silence;
    const protocol::ByteSpan bytes = std::as_bytes(std::span(data, size));
    fuzz::readFrame(bytes);
    fuzz::readDepth(bytes);
    fuzz::readServerMessage(bytes, protocol::WireFormat::kBinary);
    fuzz::readServerMessage(bytes, protocol::WireFormat::kText);
    return 0;
}
