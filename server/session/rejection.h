// Why a client's message was refused. The session's state is as it was before the message.
#pragma once

#include "core/enumerators.h"
#include "core/error.h"

#include <boost/system/result.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::session {

// The protocol's ErrorCode, under the same names.
enum class RejectCode : uint8_t {
    kMalformed,   // not a ClientMessage, or out of turn
    kOutOfRange,  // the text names field, value and range
    kUnsupported, // unknown command or enum value
    kVersion,     // protocol_major differs; close with 4001
    kCapacity,    // no session or memory left
    kRateLimit,   // more than a connection may say
    kDevice,      // the device was lost
    kControl,     // another viewer controls the room
    kToken,       // no valid token; close with 4003
};
constexpr bool isRejectCode(RejectCode code) {
    switch (code) {
    case RejectCode::kMalformed:
    case RejectCode::kOutOfRange:
    case RejectCode::kUnsupported:
    case RejectCode::kVersion:
    case RejectCode::kCapacity:
    case RejectCode::kRateLimit:
    case RejectCode::kDevice:
    case RejectCode::kControl:
    case RejectCode::kToken:
        return true;
    }
    return false;
}
inline constexpr auto kRejectCodes = enumerators<RejectCode, 255, isRejectCode>();

struct Rejection {
    RejectCode code = RejectCode::kMalformed;
    uint64_t ref_seq = 0;    // 0: not caused by a message, or its seq could not be read
    std::string field;       // as in settings/ranges.h where it has a range; empty if none
    std::string message;     // one line for a person
    bool blameless = false;  // nothing that a client could have known: never too many of them
    double too_large_by = 0; // as Error has it
};

[[nodiscard]] inline Rejection outOfRange(std::string_view field, const std::string& text) {
    return {RejectCode::kOutOfRange, 0, std::string(field), std::string(field) + " " + text};
}

template <class T>
using CommandResult = boost::system::result<T, Rejection>;

// value() on a refused command is a bug of the caller.
[[noreturn]] inline void throw_exception_from_error(const Rejection& rejection,
                                                    const boost::source_location& /*where*/) {
    throw StartupError(Error{ErrorCode::kInvalidArgument, rejection.message});
}

} // namespace froxel::session
