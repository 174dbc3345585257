// A client's text message.
#include "fuzz/command_check.h"
#include "fuzz/target.h"
#include "session/json_input.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const protocol::ByteSpan bytes = std::as_bytes(std::span(data, size));
    fuzz::readAsServer(bytes, protocol::WireFormat::kText);

    v1::ClientMessage message;
    if (session::parseJson(bytes, message)) {
        fuzz::expectSameInOtherFormat(bytes, protocol::WireFormat::kText, message);
    }
    return 0;
}
