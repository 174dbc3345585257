// Who may open a WebSocket. A browser names the page's origin; another site's page must not drive
// this server. Programs that are not browsers send no Origin and are let in: they could send any.
#pragma once

#include <cstdint>
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

// What a browser says of who has it ask, by fetch or for a page: fields of the request, none where
// it has none.
struct FetchedBy {
    std::optional<std::string_view> site{}; // Sec-Fetch-Site (W3C Fetch Metadata)
    std::optional<std::string_view> mode{}; // Sec-Fetch-Mode
    std::optional<std::string_view> dest{}; // Sec-Fetch-Dest
    std::optional<std::string_view> origin{};
    std::optional<std::string_view> referer{};
};
enum class Fetch : uint8_t {
    kOwn,     // by the server's own page, a person, or a program
    kAllowed, // by a page of another site that `allowed` lists
    kForeign, // by one that it does not
};
// A browser that asks for a picture of another site's page sends no Origin: the page is known by
// its Referer then. A link that a person follows is their own. Pure.
[[nodiscard]] Fetch
fetchOf(const FetchedBy& by, std::string_view host, std::span<const std::string> allowed);

} // namespace froxel::net
