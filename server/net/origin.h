// Who may open a WebSocket. A browser names the page's origin; another site's page must not drive
// this server. Programs that are not browsers send no Origin and are let in: they could send any.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace froxel::net {

// Whether `text` is a scheme, http or https, a host and perhaps a port, and no more. Pure.
[[nodiscard]] bool isOrigin(std::string_view text);

// True when there is no Origin, when it is https://HOST with the request's Host, or http://HOST
// where the connection is not `secure` (by TLS, here or at a proxy), or when `allowed` lists it.
// Letter case, the scheme's own port and the root's dot do not matter. "null" is foreign. Pure.
[[nodiscard]] bool originAllowed(std::optional<std::string_view> origin,
                                 std::string_view host,
                                 bool secure,
                                 std::span<const std::string> allowed);

} // namespace froxel::net
