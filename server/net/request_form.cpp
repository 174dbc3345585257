#include "net/request_form.h"

#include "core/text.h"

#include <boost/beast/core/string.hpp>
#include <boost/url/parse.hpp>

#include <array>
#include <string>

namespace froxel::net {

namespace beast = boost::beast;
namespace http = beast::http;

namespace {

// Those that somebody reads here.
constexpr std::array<beast::string_view, 7> kLists = {
    "Connection",        "Upgrade",       "Sec-WebSocket-Protocol", "X-Forwarded-For",
    "X-Forwarded-Proto", "If-None-Match", "Accept-Encoding"};
// Those that must not come twice, or others would read another one than we.
constexpr std::array<beast::string_view, 2> kSingle = {"Host", "Origin"};

bool isAbsolute(beast::string_view target) {
    return !target.empty() && target.front() != '/' && target != "*";
}

} // namespace

Result<void> settleForm(Request& request) {
    for (const auto name : kSingle) {
        if (request.count(name) > 1) {
            return Error{ErrorCode::kInvalidArgument,
                         "the field " + std::string(name) + " came more than once"};
        }
    }
    if (request.version() >= 11 && request.count(http::field::host) == 0) { // RFC 9112, 3.2
        return Error{ErrorCode::kInvalidArgument, "the field Host is missing"};
    }
    // A body whose end others see elsewhere hides the next request (RFC 9112, 6.1 and 11.2).
    if (request.count(http::field::transfer_encoding) > 0) {
        return Error{ErrorCode::kUnsupported,
                     "the Transfer-Encoding " +
                         printable(std::string(request[http::field::transfer_encoding])) +
                         " is not supported; a body needs a Content-Length"};
    }
    for (const auto name : kLists) {
        const auto lines = request.equal_range(name);
        if (lines.first == lines.second || std::next(lines.first) == lines.second) {
            continue;
        }
        std::string list;
        for (auto line = lines.first; line != lines.second; ++line) {
            list += list.empty() ? "" : ", ";
            list.append(line->value().data(), line->value().size());
        }
        request.set(name, list);
    }
    if (isAbsolute(request.target())) {
        const std::string target(request.target());
        const auto uri = boost::urls::parse_absolute_uri({target.data(), target.size()});
        if (!uri || !uri->has_authority() || uri->has_userinfo() || uri->host().empty()) {
            return Error{ErrorCode::kInvalidArgument, "the target " + printable(target) +
                                                          " is neither a path nor an absolute URI"};
        }
        const std::string host(uri->encoded_host_and_port());
        const std::string resource(uri->encoded_resource());
        request.set(http::field::host, host);
        request.target(resource.empty() || resource.front() != '/' ? "/" + resource : resource);
    }
    return {};
}

boost::system::result<boost::urls::url_view> targetOf(const Request& request) {
    return boost::urls::parse_origin_form({request.target().data(), request.target().size()});
}

} // namespace froxel::net
