// Who may open a WebSocket. A browser names the page's origin; another site's page must not drive
// this server. Programs that are not browsers send no Origin and are let in: they could send any.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace froxel::net {

// True when there is no Origin, when it is http(s)://HOST with exactly the request's Host, or when
// `allowed` lists it. Letter case of scheme and host does not matter. "null" is foreign. Pure.
[[nodiscard]] bool originAllowed(std::optional<std::string_view> origin,
                                 std::string_view host,
                                 std::span<const std::string> allowed);

} // namespace froxel::net
