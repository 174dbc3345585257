#include "protocol/framing.h"

#include "core/assert.h"
#include "core/text.h"
#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "protocol/limits.h"

#include <climits>
#include <google/protobuf/util/json_util.h>

namespace froxel::protocol {
namespace {

namespace json = google::protobuf::util;

Error invalid(std::string message) {
    return Error{ErrorCode::kInvalidArgument, std::move(message)};
}

std::string prefix(Kind kind, size_t header_length) {
    return {static_cast<char>(kMagic), static_cast<char>(kind),
            static_cast<char>(header_length & 0xFFU), static_cast<char>(header_length >> 8U)};
}

std::string toJson(const google::protobuf::Message& message) {
    std::string text;
    const auto status = json::MessageToJsonString(message, &text);
    FROXEL_ASSERT(status.ok(), "a message of our own has no JSON form");
    return text;
}

bool parse(ByteSpan bytes, google::protobuf::Message& message) {
    return bytes.size() <= INT_MAX &&
           message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

// Parts must tile the payload: the first at 0, each after the one before, none left over.
Result<void> checkParts(const v1::FrameHeader& header, size_t payload_bytes) {
    uint64_t end = 0;
    for (const v1::Part& part : header.parts()) {
        if (part.offset() != end) {
            return invalid("frame: a part starts at byte " + std::to_string(part.offset()) +
                           ", the one before ends at " + std::to_string(end));
        }
        end += part.length();
    }
    if (end != payload_bytes) {
        return invalid("frame: parts cover " + std::to_string(end) + " bytes of " +
                       std::to_string(payload_bytes));
    }
    return {};
}

std::string prefixed(Kind kind, const google::protobuf::Message& header) {
    const size_t length = header.ByteSizeLong();
    FROXEL_ASSERT(length > 0 && length <= kMaxFrameHeaderBytes, "header out of its bounds");
    std::string bytes = prefix(kind, length);
    header.AppendToString(&bytes);
    return bytes;
}

// Fills `header` and returns what follows it. `name`: of such a message, for errors.
Result<ByteSpan> decodePrefixed(ByteSpan message,
                                Kind expected,
                                const std::string& name,
                                google::protobuf::Message& header) {
    const auto kind = binaryKind(message);
    if (!kind) {
        return kind.error();
    }
    if (*kind != expected) {
        return invalid("not a " + name + " but another kind of server message");
    }
    const size_t length =
        std::to_integer<size_t>(message[2]) | (std::to_integer<size_t>(message[3]) << 8U);
    const ByteSpan rest = message.subspan(kPrefixBytes);
    if (length == 0 || length > kMaxFrameHeaderBytes || length > rest.size()) {
        return invalid(name + " header of " + std::to_string(length) + " bytes; " +
                       std::to_string(rest.size()) + " are there and 1 to " +
                       std::to_string(kMaxFrameHeaderBytes) + " are allowed");
    }
    if (!parse(rest.first(length), header)) {
        return invalid(name + " header is not a " + header.GetDescriptor()->name());
    }
    return rest.subspan(length);
}

} // namespace

std::string encodeFramePrefix(const v1::FrameHeader& header) {
    return prefixed(Kind::kFrame, header);
}

std::string encodeDepthPrefix(const v1::DepthMeshHeader& header) {
    return prefixed(Kind::kDepth, header);
}

Result<Kind> binaryKind(ByteSpan message) {
    if (message.size() < kPrefixBytes) {
        return invalid("server message of " + std::to_string(message.size()) +
                       " bytes; it starts with a prefix of 4");
    }
    const auto magic = std::to_integer<unsigned>(message[0]);
    if (magic != kMagic) {
        return invalid("server message starts with byte " + std::to_string(magic) + ", not 247");
    }
    const auto kind = std::to_integer<unsigned>(message[1]);
    if (kind < static_cast<unsigned>(Kind::kFrame) || kind > static_cast<unsigned>(Kind::kDepth)) {
        return invalid("server message of kind " + std::to_string(kind) +
                       "; known are 1 (frame), 2 (message) and 3 (depth)");
    }
    return static_cast<Kind>(kind);
}

Result<ByteSpan> decodeFrame(ByteSpan message, v1::FrameHeader& header) {
    auto payload = decodePrefixed(message, Kind::kFrame, "frame", header);
    if (!payload) {
        return payload;
    }
    if (const auto parts = checkParts(header, payload->size()); !parts) {
        return parts.error();
    }
    return payload;
}

Result<ByteSpan> decodeDepth(ByteSpan message, v1::DepthMeshHeader& header) {
    return decodePrefixed(message, Kind::kDepth, "depth", header);
}

std::string encodeServerMessage(const v1::ServerMessage& message, WireFormat format) {
    if (format == WireFormat::kText) {
        return toJson(message);
    }
    std::string bytes = prefix(Kind::kServerMessage, 0);
    message.AppendToString(&bytes);
    return bytes;
}

Result<void> decodeServerMessage(ByteSpan payload, WireFormat format, v1::ServerMessage& message) {
    if (format == WireFormat::kText) {
        json::JsonParseOptions options;
        options.ignore_unknown_fields = true; // a newer server may say more
        const google::protobuf::StringPiece text(reinterpret_cast<const char*>(payload.data()),
                                                 payload.size());
        const auto status = json::JsonStringToMessage(text, &message, options);
        return status.ok() ? Result<void>()
                           : invalid("not the JSON of a ServerMessage: " +
                                     printable(status.ToString(), 200));
    }
    const auto kind = binaryKind(payload);
    if (!kind) {
        return kind.error();
    }
    if (*kind != Kind::kServerMessage || payload[2] != std::byte{0} || payload[3] != std::byte{0}) {
        return invalid("not a server message");
    }
    if (!parse(payload.subspan(kPrefixBytes), message)) {
        return invalid("not a ServerMessage");
    }
    return {};
}

std::string encodeClientMessage(const v1::ClientMessage& message, WireFormat format) {
    return format == WireFormat::kText ? toJson(message) : message.SerializeAsString();
}

} // namespace froxel::protocol
