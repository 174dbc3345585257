// The JSON of protocol messages, untrusted.
#pragma once

#include "protocol/framing.h"
#include "session/rejection.h"

#include <google/protobuf/message.h>

namespace froxel::session {

// Fills `message` from canonical protobuf JSON. Unknown fields are ignored, at any depth. Refused:
// kMalformed for what is not JSON, is nested deeper than kMaxJsonDepth, repeats a key or has a
// value of the wrong type; kUnsupported for an unknown enum name; kOutOfRange for a number that
// the field's type cannot hold. The rejection's ref_seq is set where the message has a seq that
// could be read.
[[nodiscard]] CommandResult<void> parseJson(protocol::ByteSpan text,
                                            google::protobuf::Message& message);

} // namespace froxel::session
