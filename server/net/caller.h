// Who is at the other end of a connection, as far as places and costs go.
#pragma once

#include "session/account.h"

#include <optional>

namespace froxel::net {

struct Caller {
    session::Account address;
    // The address is 127.0.0.1 or ::1: a proxy on this host that is not named as trusted, or its
    // user. Whoever else is behind it cannot be told apart, so it has no limit of its own.
    bool local = false;
    std::optional<session::Account> token; // that it has shown

    [[nodiscard]] const session::Account& account() const { return token ? *token : address; }
    // Whose limits hold; none: no one's.
    [[nodiscard]] std::optional<session::Account> limited() const {
        return local && !token ? std::nullopt : std::optional(account());
    }
};

} // namespace froxel::net
