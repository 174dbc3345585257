// Why and how a connection closes.
#pragma once

#include "core/error.h"
#include "protocol/limits.h"

#include <boost/system/result.hpp>

#include <string>

namespace froxel::net {

struct Closing {
    protocol::CloseCode code = protocol::CloseCode::kNormal;
    std::string reason; // at most 123 bytes, RFC 6455 section 5.5
};

// A place, or why there is none: the reason is one line for a person.
template <class T>
using PlaceResult = boost::system::result<T, Closing>;

// value() of a place that was refused is a bug of the caller.
[[noreturn]] inline void throw_exception_from_error(const Closing& closing,
                                                    const boost::source_location& /*where*/) {
    throw StartupError(Error{ErrorCode::kCapacity, closing.reason});
}

} // namespace froxel::net
