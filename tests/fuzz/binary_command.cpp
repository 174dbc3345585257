// A client's binary message.
#include "fuzz/command_check.h"
#include "fuzz/target.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const protocol::ByteSpan bytes = std::as_bytes(std::span(data, size));
    fuzz::readAsServer(bytes, protocol::WireFormat::kBinary);

    const google::protobuf::LogSilencer silence;
    v1::ClientMessage message;
    google::protobuf::io::CodedInputStream stream(data, static_cast<int>(size));
    stream.SetRecursionLimit(16); // JSON has no unknown fields, which may be nested deeper
    if (message.ParseFromCodedStream(&stream) && stream.ConsumedEntireMessage()) {
        fuzz::expectSameInOtherFormat(bytes, protocol::WireFormat::kBinary, message);
    }
    return 0;
}
