#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "protocol/framing.h"
#include "protocol/limits.h"
#include "unit/protocol/hex.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::protocol {
namespace {

using ::testing::HasSubstr;

v1::FrameHeader headerFor(std::initializer_list<std::pair<uint32_t, uint32_t>> parts) {
    v1::FrameHeader header;
    header.set_frame_id(1);
    for (const auto& [offset, length] : parts) {
        v1::Part& part = *header.add_parts();
        part.set_offset(offset);
        part.set_length(length);
        part.set_codec(v1::CODEC_JPEG);
    }
    return header;
}

std::string decodeError(std::string_view message) {
    v1::FrameHeader header;
    const auto payload = decodeFrame(bytesOf(message), header);
    return payload ? "accepted" : payload.error().message;
}

TEST(Frame, PrefixAndPayload_ComeBack) {
    const v1::FrameHeader header = headerFor({{0, 3}, {3, 2}});
    const std::string prefix = encodeFramePrefix(header);
    EXPECT_EQ(toHex(prefix.substr(0, 2)), "f701");
    EXPECT_EQ(prefix.size(), kPrefixBytes + header.ByteSizeLong());
    const std::string message = prefix + "ABCDE";
    v1::FrameHeader back;
    const auto payload = decodeFrame(bytesOf(message), back);
    ASSERT_TRUE(payload) << payload.error().message;
    EXPECT_EQ(back.SerializeAsString(), header.SerializeAsString());
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(payload->data()), payload->size()),
              "ABCDE");
}

TEST(Depth, PrefixAndBytes_ComeBack) {
    v1::DepthMeshHeader header;
    header.set_number(3);
    header.set_columns(2);
    const std::string message = encodeDepthPrefix(header) + "AB";
    EXPECT_EQ(toHex(message.substr(0, 2)), "f703");
    EXPECT_EQ(binaryKind(bytesOf(message)).value(), Kind::kDepth);
    v1::DepthMeshHeader back;
    const auto bytes = decodeDepth(bytesOf(message), back);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(back.SerializeAsString(), header.SerializeAsString());
    EXPECT_EQ(bytes->size(), 2U);
    EXPECT_THAT(decodeError(message), HasSubstr("not a frame"));
    const auto other = decodeDepth(bytesOf(encodeFramePrefix(headerFor({}))), back);
    EXPECT_THAT(other.error().message, HasSubstr("not a depth"));
}

TEST(Frame, LongHeader_UsesBothLengthBytes) {
    v1::FrameHeader header = headerFor({});
    header.add_passes()->set_name(std::string(700, 'p'));
    const std::string prefix = encodeFramePrefix(header);
    EXPECT_EQ(static_cast<size_t>(static_cast<uint8_t>(prefix[2])) +
                  256U * static_cast<uint8_t>(prefix[3]),
              prefix.size() - kPrefixBytes);
    EXPECT_EQ(decodeError(prefix), "accepted");
}

TEST(Frame, WrongPrefix_IsNamed) {
    EXPECT_THAT(decodeError(""), HasSubstr("0 bytes"));
    EXPECT_THAT(decodeError("\xf7\x01\x01"), HasSubstr("3 bytes"));
    EXPECT_THAT(decodeError("\x01\x01\x01\x01"), HasSubstr("byte 1, not 247"));
    EXPECT_THAT(decodeError(std::string_view("\xf7\x09\x01\x00", 4)), HasSubstr("kind 9"));
    EXPECT_THAT(decodeError(std::string_view("\xf7\x02\x00\x00", 4)), HasSubstr("not a frame"));
}

TEST(Frame, HeaderLength_MustFit) {
    EXPECT_THAT(decodeError(std::string_view("\xf7\x01\x00\x00", 4)), HasSubstr("of 0 bytes"));
    EXPECT_THAT(decodeError(std::string("\xf7\x01\x05\x00", 4) + "ab"), HasSubstr("of 5 bytes"));
    std::string long_header("\xf7\x01\x01\x10", 4);
    long_header.append(5000, '\0');
    EXPECT_THAT(decodeError(long_header), HasSubstr("of 4097 bytes"));
    EXPECT_THAT(decodeError(std::string_view("\xf7\x01\x02\x00\xff\xff", 6)),
                HasSubstr("not a FrameHeader"));
}

TEST(Frame, Parts_MustTileThePayload) {
    const auto error = [](std::initializer_list<std::pair<uint32_t, uint32_t>> parts,
                          const std::string& payload) {
        return decodeError(encodeFramePrefix(headerFor(parts)) + payload);
    };
    EXPECT_EQ(error({{0, 2}, {2, 3}}, "12345"), "accepted");
    EXPECT_EQ(error({}, ""), "accepted");
    EXPECT_THAT(error({{0, 2}, {3, 2}}, "12345"), HasSubstr("starts at byte 3"));
    EXPECT_THAT(error({{1, 4}}, "12345"), HasSubstr("starts at byte 1"));
    EXPECT_THAT(error({{0, 2}, {1, 4}}, "12345"), HasSubstr("starts at byte 1"));
    EXPECT_THAT(error({{0, 4}}, "12345"), HasSubstr("4 bytes of 5"));
    EXPECT_THAT(error({{0, 6}}, "12345"), HasSubstr("6 bytes of 5"));
    // Lengths that would wrap 32 bits back to the payload's size.
    EXPECT_NE(error({{0, 0xFFFFFFFFU}, {0xFFFFFFFFU, 6}}, "12345"), "accepted");
}

TEST(ServerMessage, BothFormats_RoundTrip) {
    v1::ServerMessage message;
    message.mutable_pong()->set_ref_seq(7);
    message.mutable_pong()->set_client_time_us(1ULL << 60U);
    for (const WireFormat format : {WireFormat::kBinary, WireFormat::kText}) {
        const std::string payload = encodeServerMessage(message, format);
        v1::ServerMessage back;
        ASSERT_TRUE(decodeServerMessage(bytesOf(payload), format, back));
        EXPECT_EQ(back.SerializeAsString(), message.SerializeAsString());
    }
    EXPECT_EQ(toHex(encodeServerMessage(message, WireFormat::kBinary)).substr(0, 8), "f7020000");
    EXPECT_EQ(encodeServerMessage(message, WireFormat::kText),
              R"({"pong":{"refSeq":"7","clientTimeUs":"1152921504606846976"}})");
}

TEST(ServerMessage, NewerServersFields_AreIgnored) {
    v1::ServerMessage back;
    EXPECT_TRUE(decodeServerMessage(bytesOf(R"({"pong":{"refSeq":"7","jitterUs":3},"extra":[1]})"),
                                    WireFormat::kText, back));
    EXPECT_EQ(back.pong().ref_seq(), 7U);
}

TEST(ServerMessage, Garbage_IsAnError) {
    v1::ServerMessage back;
    EXPECT_FALSE(decodeServerMessage(bytesOf("{"), WireFormat::kText, back));
    EXPECT_FALSE(decodeServerMessage(bytesOf("{}"), WireFormat::kBinary, back));
    EXPECT_FALSE(decodeServerMessage(bytesOf("\xf7\x01\x02\x02"), WireFormat::kBinary, back));
    EXPECT_FALSE(decodeServerMessage(bytesOf(std::string_view("\xf7\x02\x00\x00\xff", 5)),
                                     WireFormat::kBinary, back));
}

TEST(ServerMessage, BrokenJson_IsRefusedInOneLine) {
    v1::ServerMessage back;
    const auto read = decodeServerMessage(bytesOf("{\n\"pong\" 1}"), WireFormat::kText, back);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
}

TEST(ClientMessage, BothFormats_AreBare) {
    v1::ClientMessage message;
    message.set_seq(5);
    message.mutable_ack()->set_frame_id(3);
    EXPECT_EQ(encodeClientMessage(message, WireFormat::kBinary), message.SerializeAsString());
    EXPECT_EQ(encodeClientMessage(message, WireFormat::kText),
              R"({"seq":"5","ack":{"frameId":"3"}})");
}

} // namespace
} // namespace froxel::protocol
