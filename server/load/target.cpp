#include "load/target.h"

#include "core/text.h"

#include <boost/url/parse.hpp>

#include <string>

namespace froxel::load {

namespace urls = boost::urls;

Result<Target> parseTarget(std::string_view text) {
    const auto refuse = [text](const std::string& why) {
        return Error{ErrorCode::kInvalidArgument, "'" + printable(text, 200) + "' " + why +
                                                      "; it must be like ws://127.0.0.1:8080/ws"};
    };
    const auto parsed = urls::parse_uri({text.data(), text.size()});
    if (!parsed) {
        return refuse("is not a URL");
    }
    const urls::url_view& url = *parsed;
    const bool tls = url.scheme() == "wss" || url.scheme() == "https";
    if (!tls && url.scheme() != "ws" && url.scheme() != "http") {
        return refuse("is not of ws:// or wss://");
    }
    if (url.encoded_host().empty() || url.has_userinfo() || url.has_fragment()) {
        return refuse("has no host, or a user or fragment");
    }
    if (const std::string host = url.host();
        host.starts_with('.') || host.find('\0') != std::string::npos) {
        return refuse("has an invalid host name");
    }
    if (url.has_port() && url.port_number() == 0) {
        return refuse("has no port from 1 to 65535");
    }
    Target target;
    target.tls = tls;
    target.host = url.host_type() == urls::host_type::ipv6
                      ? std::string(url.host_ipv6_address().to_string())
                      : std::string(url.host());
    target.port = url.has_port() ? std::string(url.port()) : tls ? "443" : "80";
    target.authority = std::string(url.encoded_host_and_port());
    const std::string path(url.encoded_path());
    target.resource = path.empty() || path == "/" ? "/ws" : path;
    if (url.has_query()) {
        target.resource += "?" + std::string(url.encoded_query());
    }
    return target;
}

} // namespace froxel::load
