// Where viewers connect to, from a URL.
#pragma once

#include "core/error.h"

#include <string>
#include <string_view>

namespace froxel::load {

struct Target {
    std::string host;      // a name or an address, without brackets
    std::string port;      // digits
    std::string authority; // host and port as the Host header has them
    std::string resource;  // path and query, "/ws?room=a"
    bool tls = false;

    bool operator==(const Target&) const = default;
};

// ws://HOST[:PORT][/PATH] or wss://, or the http:// or https:// URL that `froxel serve` prints;
// without a path /ws.
// Pure. Errors: kInvalidArgument, quoting the text.
[[nodiscard]] Result<Target> parseTarget(std::string_view url);

} // namespace froxel::load
