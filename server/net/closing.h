// Why and how a connection closes.
#pragma once

#include "protocol/limits.h"

#include <string>

namespace froxel::net {

struct Closing {
    protocol::CloseCode code = protocol::CloseCode::kNormal;
    std::string reason; // at most 123 bytes, RFC 6455 section 5.5
};

} // namespace froxel::net
