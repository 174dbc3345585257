#include "session/command_reader.h"

#include "core/text.h"
#include "protocol/limits.h"

namespace froxel::session {
namespace {

CommandResult<void> checkVersion(const Hello& hello) {
    if (hello.major == protocol::kMajor) {
        return {};
    }
    return Rejection{RejectCode::kVersion, 0, "protocol_major",
                     "protocol_major is " + numberText(hello.major) + "; this server speaks " +
                         numberText(protocol::kMajor)};
}

} // namespace

CommandResult<CommandMessage> CommandReader::check(CommandResult<CommandMessage> command,
                                                   protocol::WireFormat format) {
    if (!command) {
        return command;
    }
    const uint64_t seq = command->stamp.seq;
    const auto* hello = std::get_if<Hello>(&command->body);
    if ((hello != nullptr) == greeted()) {
        return Rejection{RejectCode::kMalformed, seq, "hello",
                         greeted() ? "hello came twice" : "hello must be the first message"};
    }
    if (seq <= last_seq_) {
        return Rejection{RejectCode::kOutOfRange, seq, "seq",
                         "seq is " + numberText(seq) + "; it must be above " +
                             numberText(last_seq_)};
    }
    if (hello != nullptr) {
        if (auto version = checkVersion(*hello); !version) {
            Rejection rejection = version.error();
            rejection.ref_seq = seq;
            return rejection;
        }
        reply_format_ = format;
    }
    last_seq_ = seq;
    return command;
}

size_t CommandReader::maxMessageBytes() const {
    return greeted() ? protocol::kMaxMessageBytes : protocol::kMaxHelloBytes;
}

} // namespace froxel::session
