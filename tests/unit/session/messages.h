// Shorthand for the session's tests: client messages as text and bytes, and what became of them.
#pragma once

#include "froxel/v1/client.pb.h"
#include "protocol/framing.h"
#include "session/command_decode.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <variant>

namespace froxel::session {

inline CommandResult<CommandMessage> decodeText(std::string_view json) {
    return decodeCommand(protocol::bytesOf(json), protocol::WireFormat::kText);
}

inline CommandResult<CommandMessage> decodeBinary(std::string_view bytes) {
    return decodeCommand(protocol::bytesOf(bytes), protocol::WireFormat::kBinary);
}

inline CommandResult<CommandMessage> decodeBinary(const v1::ClientMessage& message) {
    return decodeBinary(message.SerializeAsString());
}

// {"seq":1, BODY} through the JSON decoder.
inline CommandResult<CommandMessage> decodeBody(const std::string& body) {
    return decodeText("{\"seq\":1," + body + "}");
}

inline v1::ClientMessage clientMessage(uint64_t seq = 1) {
    v1::ClientMessage message;
    message.set_seq(seq);
    return message;
}

// The command of an accepted message; fails the test and gives a default one otherwise.
template <class T>
T accepted(const CommandResult<CommandMessage>& result) {
    if (!result) {
        ADD_FAILURE() << "refused: " << result.error().message;
        return {};
    }
    const T* command = std::get_if<T>(&result->body);
    if (command == nullptr) {
        ADD_FAILURE() << "another command: index " << result->body.index();
        return {};
    }
    return *command;
}

// Why a message was refused; fails the test where it was accepted.
inline Rejection refused(const CommandResult<CommandMessage>& result) {
    if (result) {
        ADD_FAILURE() << "accepted";
        return {};
    }
    return result.error();
}

} // namespace froxel::session
