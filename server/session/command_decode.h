// Untrusted bytes to validated commands: the only code that reads a client's protobuf or JSON.
#pragma once

#include "protocol/framing.h"
#include "session/command.h"
#include "session/rejection.h"

namespace froxel::session {

// One WebSocket message, already within the transport's size cap. Pure; any thread.
// Unknown fields are ignored. Refused: kMalformed (not a ClientMessage, no seq), kUnsupported
// (no command that this server knows, unknown enum value), kOutOfRange (field, value and range
// in the message).
[[nodiscard]] CommandResult<CommandMessage> decodeCommand(protocol::ByteSpan message,
                                                          protocol::WireFormat format);

} // namespace froxel::session
