// One message of a client, as a connection reads it, and as the other format says it.
#pragma once

#include "froxel/v1/client.pb.h"
#include "protocol/framing.h"

namespace froxel::fuzz {

void readAsServer(protocol::ByteSpan bytes, protocol::WireFormat format);

// `message` is what `bytes` say; the other format of it is let in or refused just the same.
void expectSameInOtherFormat(protocol::ByteSpan bytes,
                             protocol::WireFormat format,
                             const v1::ClientMessage& message);

} // namespace froxel::fuzz
