// What a link to a view leads to. Whoever shows links (chats, social networks) asks for no fragment
// and runs no script: this page tells it of a picture of the view (Open Graph, ogp.me), and leads
// people on to the page that streams it.
#pragma once

#include "net/http_site.h"

#include <string_view>

namespace froxel::net {

inline constexpr std::string_view kLinkPath = "/view";

// The request's query is what the page's address has behind its '#', and `room`. `secure`: it came
// by TLS. `pictures`: who asks without a token gets stills. Pure.
[[nodiscard]] Response linkPreview(const Request& request, bool secure, bool pictures);

} // namespace froxel::net
