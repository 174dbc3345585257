#include "protocol/limits.h"
#include "session/command_reader.h"
#include "unit/session/messages.h"

namespace froxel::session {
namespace {

using protocol::WireFormat;

std::string hello(uint64_t seq, uint32_t major = protocol::kMajor, uint32_t minor = 0) {
    v1::ClientMessage message = clientMessage(seq);
    message.mutable_hello()->set_protocol_major(major);
    message.mutable_hello()->set_protocol_minor(minor);
    return message.SerializeAsString();
}

std::string ping(uint64_t seq) {
    v1::ClientMessage message = clientMessage(seq);
    message.mutable_ping();
    return message.SerializeAsString();
}

CommandResult<CommandMessage> read(CommandReader& reader, const std::string& bytes) {
    return reader.read(protocol::bytesOf(bytes), WireFormat::kBinary);
}

TEST(CommandReader, HelloThenCommands_AreRead) {
    CommandReader reader;
    EXPECT_FALSE(reader.greeted());
    EXPECT_EQ(reader.maxMessageBytes(), protocol::kMaxHelloBytes);
    accepted<Hello>(read(reader, hello(1)));
    EXPECT_TRUE(reader.greeted());
    EXPECT_EQ(reader.maxMessageBytes(), protocol::kMaxMessageBytes);
    accepted<Ping>(read(reader, ping(2)));
    accepted<Ping>(read(reader, ping(100)));
}

TEST(CommandReader, CommandBeforeHello_IsRefused) {
    CommandReader reader;
    EXPECT_EQ(refused(read(reader, ping(1))).message, "hello must be the first message");
    EXPECT_FALSE(reader.greeted());
    accepted<Hello>(read(reader, hello(1)));
}

TEST(CommandReader, SecondHello_IsRefused) {
    CommandReader reader;
    accepted<Hello>(read(reader, hello(1)));
    EXPECT_EQ(refused(read(reader, hello(2))).message, "hello came twice");
    accepted<Ping>(read(reader, ping(2)));
}

TEST(CommandReader, OtherMajor_IsAVersionError_OtherMinorIsNot) {
    CommandReader reader;
    for (const uint32_t major : {0U, 2U, 0xFFFFFFFFU}) {
        const Rejection rejection = refused(read(reader, hello(7, major)));
        EXPECT_EQ(rejection.code, RejectCode::kVersion);
        EXPECT_EQ(rejection.ref_seq, 7U);
        EXPECT_FALSE(reader.greeted());
    }
    accepted<Hello>(read(reader, hello(7, protocol::kMajor, 99)));
}

TEST(CommandReader, Seq_MustGrow) {
    CommandReader reader;
    accepted<Hello>(read(reader, hello(5)));
    for (const uint64_t seq : {5ULL, 4ULL, 1ULL}) {
        const Rejection rejection = refused(read(reader, ping(seq)));
        EXPECT_EQ(rejection.field, "seq");
        EXPECT_EQ(rejection.message, "seq is " + std::to_string(seq) + "; it must be above 5");
    }
    accepted<Ping>(read(reader, ping(6)));
    accepted<Ping>(read(reader, ping(~0ULL)));
    EXPECT_FALSE(read(reader, ping(1)));
}

TEST(CommandReader, RefusedMessage_LeavesItsSeqFree) {
    CommandReader reader;
    accepted<Hello>(read(reader, hello(1)));
    EXPECT_FALSE(read(reader, clientMessage(2).SerializeAsString()));
    accepted<Ping>(read(reader, ping(2)));
}

TEST(CommandReader, ReplyFormat_FollowsTheHello) {
    CommandReader text_client;
    const std::string_view text_hello = R"({"seq":1,"hello":{"protocolMajor":1}})";
    accepted<Hello>(text_client.read(protocol::bytesOf(text_hello), WireFormat::kText));
    EXPECT_EQ(text_client.replyFormat(), WireFormat::kText);
    accepted<Ping>(read(text_client, ping(2)));
    EXPECT_EQ(text_client.replyFormat(), WireFormat::kText);

    CommandReader binary_client;
    EXPECT_EQ(binary_client.replyFormat(), WireFormat::kBinary);
    accepted<Hello>(read(binary_client, hello(1)));
    accepted<Ping>(
        binary_client.read(protocol::bytesOf(R"({"seq":2,"ping":{}})"), WireFormat::kText));
    EXPECT_EQ(binary_client.replyFormat(), WireFormat::kBinary);
}

} // namespace
} // namespace froxel::session
