// One connection's conversation rules on top of decodeCommand: Hello first and once, the right
// protocol version, seq strictly increasing. One thread at a time.
#pragma once

#include "session/command_decode.h"

#include <optional>

namespace froxel::session {

class CommandReader {
  public:
    // The format of a message is that of its WebSocket message (text or binary); a client may
    // mix them. A refused message does not count: its seq may be used again.
    [[nodiscard]] CommandResult<CommandMessage> read(protocol::ByteSpan message,
                                                     protocol::WireFormat format) {
        return check(decodeCommand(message, format), format);
    }
    // The same for one that was decoded elsewhere.
    [[nodiscard]] CommandResult<CommandMessage> check(CommandResult<CommandMessage> command,
                                                      protocol::WireFormat format);

    [[nodiscard]] bool greeted() const { return reply_format_.has_value(); }
    // How ServerMessages go to this client: as its Hello came. Binary before Hello.
    [[nodiscard]] protocol::WireFormat replyFormat() const {
        return reply_format_.value_or(protocol::WireFormat::kBinary);
    }
    // The largest message that read() takes next; the transport enforces it.
    [[nodiscard]] size_t maxMessageBytes() const;

  private:
    std::optional<protocol::WireFormat> reply_format_;
    uint64_t last_seq_ = 0;
};

} // namespace froxel::session
