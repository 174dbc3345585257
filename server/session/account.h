// Whom a session's places and costs are charged to.
#pragma once

#include <compare>
#include <string>

namespace froxel::session {

// The token that was shown, or else the address that it came from (IPv6 by /64; behind trusted
// proxies by X-Forwarded-For). A name and no secret: it may be logged.
struct Account {
    std::string key; // "token 3", "192.0.2.7", "2001:db8:1:2::/64"

    auto operator<=>(const Account&) const = default;
};

} // namespace froxel::session
