// Who is at the other end of a connection, as far as places and costs go.
#pragma once

#include "session/account.h"

#include <cstdint>

namespace froxel::net {

struct Caller {
    enum class Kind : uint8_t {
        kLocal, // on this host: a proxy that is not named as trusted, or a test; no limit is its
                // own
        kAddress,
        kToken,
    };
    Kind kind = Kind::kLocal;
    session::Account account;
};

} // namespace froxel::net
