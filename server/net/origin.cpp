#include "net/origin.h"

#include "net/host_names.h"

#include <boost/url/parse.hpp>
#include <boost/url/url_view.hpp>

#include <algorithm>
#include <cstdint>

namespace froxel::net {

namespace urls = boost::urls;

namespace {

constexpr uint16_t kHttpPort = 80;
constexpr uint16_t kHttpsPort = 443;

struct Origin {
    bool encrypted = false;
    std::string host;
    uint16_t port = 0;
    bool operator==(const Origin&) const = default;
};

// None: it is a port that there is not, or the authority has more than a host and a port.
std::optional<Origin> originOf(bool encrypted, const urls::authority_view& authority) {
    Origin origin{encrypted, hostIn(authority), encrypted ? kHttpsPort : kHttpPort};
    if (!authority.port().empty()) {
        origin.port = authority.port_number();
    }
    if (origin.host.empty() || origin.port == 0 || authority.has_userinfo()) {
        return {};
    }
    return origin;
}

// None: its scheme is another than http and https, or it has no authority.
std::optional<Origin> originIn(const urls::url_view& uri) {
    const bool encrypted = uri.scheme_id() == urls::scheme::https;
    if ((!encrypted && uri.scheme_id() != urls::scheme::http) || !uri.has_authority()) {
        return {};
    }
    return originOf(encrypted, uri.authority());
}

// Scheme, host and port alone (RFC 6454 section 6.2).
std::optional<Origin> parsed(std::string_view text) {
    const auto uri = urls::parse_uri({text.data(), text.size()});
    if (!uri || !uri->encoded_path().empty() || uri->has_query() || uri->has_fragment()) {
        return {};
    }
    return originIn(*uri);
}

// Of a page's address.
std::optional<Origin> siteOf(std::string_view address) {
    const auto uri = urls::parse_uri({address.data(), address.size()});
    return uri ? originIn(*uri) : std::nullopt;
}

} // namespace

bool isOrigin(std::string_view text) {
    return parsed(text).has_value();
}

bool originAllowed(std::optional<std::string_view> origin,
                   std::string_view host,
                   bool secure,
                   std::span<const std::string> allowed) {
    if (!origin) {
        return true;
    }
    const auto page = parsed(*origin);
    if (!page) {
        return false;
    }
    if (std::any_of(allowed.begin(), allowed.end(),
                    [&](const std::string& listed) { return parsed(listed) == page; })) {
        return true;
    }
    const auto authority = urls::parse_authority({host.data(), host.size()});
    return authority && originOf(page->encrypted, *authority) == page &&
           (page->encrypted || !secure);
}

Fetch fetchOf(const FetchedBy& by, std::string_view host, std::span<const std::string> allowed) {
    const bool elsewhere = by.site && *by.site != "same-origin" && *by.site != "none";
    if (!elsewhere) {
        return by.site || originAllowed(by.origin, host, false, allowed) ? Fetch::kOwn
                                                                         : Fetch::kForeign;
    }
    if (by.mode == "navigate" && by.dest == "document") {
        return Fetch::kOwn;
    }
    const auto page = by.origin    ? parsed(*by.origin)
                      : by.referer ? siteOf(*by.referer)
                                   : std::nullopt;
    const bool listed = page && std::any_of(allowed.begin(), allowed.end(),
                                            [&](const auto& text) { return parsed(text) == page; });
    return listed ? Fetch::kAllowed : Fetch::kForeign;
}

} // namespace froxel::net
