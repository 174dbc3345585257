#include "fuzz/command_check.h"

#include "core/assert.h"
#include "fuzz/target.h"
#include "protocol/limits.h"
#include "session/command_reader.h"
#include "support/command_promises.h"

namespace froxel::fuzz {

using protocol::WireFormat;

void readAsServer(protocol::ByteSpan bytes, WireFormat format) {
    session::CommandReader reader;
    if (bytes.size() <= reader.maxMessageBytes()) {
        expectNoFault(test::faultOf(reader.read(bytes, format)));
    }
    if (!reader.greeted()) {
        v1::ClientMessage hello;
        hello.set_seq(1);
        hello.mutable_hello()->set_protocol_major(protocol::kMajor);
        const std::string greeting = hello.SerializeAsString();
        const auto greeted = reader.read(protocol::bytesOf(greeting), WireFormat::kBinary);
        FROXEL_ASSERT(greeted, "a refused message does not count");
    }
    if (bytes.size() <= reader.maxMessageBytes()) {
        const auto read = reader.read(bytes, format);
        expectNoFault(test::faultOf(read));
        FROXEL_ASSERT(!read || !reader.read(bytes, format), "no seq counts twice");
    }
}

void expectSameInOtherFormat(protocol::ByteSpan bytes,
                             WireFormat format,
                             const v1::ClientMessage& message) {
    const auto here = session::decodeCommand(bytes, format);
    const WireFormat other =
        format == WireFormat::kBinary ? WireFormat::kText : WireFormat::kBinary;
    const std::string translated = protocol::encodeClientMessage(message, other);
    const auto there = session::decodeCommand(protocol::bytesOf(translated), other);
    FROXEL_ASSERT(here.has_value() == there.has_value(), "let in one format alone");
    if (here) {
        FROXEL_ASSERT(here->stamp == there->stamp, "another stamp in the other format");
        FROXEL_ASSERT(here->body.index() == there->body.index(), "another command there");
    } else {
        FROXEL_ASSERT(here.error().code == there.error().code, "refused for another reason");
        FROXEL_ASSERT(here.error().ref_seq == there.error().ref_seq, "refused by another seq");
    }
}

} // namespace froxel::fuzz
