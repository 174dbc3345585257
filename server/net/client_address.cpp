#include "net/client_address.h"

#include "core/text.h"

#include <boost/beast/core/string.hpp>

#include <algorithm>
#include <optional>

namespace froxel::net {

namespace ip = boost::asio::ip;
using boost::beast::iequals;

namespace {

constexpr unsigned short kAccountBits = 64; // of an IPv6 address

ip::address plain(const ip::address& address) {
    return address.is_v6() && address.to_v6().is_v4_mapped()
               ? ip::address(ip::make_address_v4(ip::v4_mapped, address.to_v6()))
               : address;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t";
    const size_t begin = text.find_first_not_of(kSpace);
    return begin == std::string_view::npos
               ? std::string_view()
               : text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

// An address as some proxies write it (Azure's Application Gateway, IIS): IPv6 may be in brackets,
// and a port behind. None: brackets have no end, or something else follows.
std::optional<std::string_view> withoutPort(std::string_view text) {
    const auto isPort = [](std::string_view end) {
        return end.empty() || (end.size() > 1 && end.front() == ':' &&
                               end.find_first_not_of("0123456789", 1) == std::string_view::npos);
    };
    const bool bracketed = text.starts_with('[');
    const bool one_colon = text.find(':') == text.rfind(':');
    const size_t end = bracketed ? text.find(']') : one_colon ? text.find(':') : text.size();
    if (bracketed && end == std::string_view::npos) {
        return {};
    }
    const std::string_view address = text.substr(bracketed ? 1 : 0, bracketed ? end - 1 : end);
    const size_t rest = std::min(text.size(), bracketed ? end + 1 : end);
    return isPort(text.substr(rest)) ? std::optional(address) : std::nullopt;
}

std::optional<ip::address> parsed(std::string_view text) {
    const auto alone = withoutPort(text);
    boost::system::error_code failure;
    const ip::address address = ip::make_address(std::string(alone.value_or("")), failure);
    return failure ? std::nullopt : std::optional(plain(address));
}

// The last of a list, which is without it then.
std::string_view takeLast(std::string_view& list) {
    const size_t comma = list.rfind(',');
    const bool only = comma == std::string_view::npos;
    const std::string_view last = trimmed(only ? list : list.substr(comma + 1));
    list = only ? std::string_view() : list.substr(0, comma);
    return last;
}

struct Way {
    ip::address client;
    size_t trusted_hops = 0;
};

Way walk(const ip::address& peer, std::string_view forwarded_for, const TrustedProxies& proxies) {
    Way way{plain(peer)};
    while (proxies.contains(way.client)) {
        ++way.trusted_hops;
        const auto hop = forwarded_for.empty() ? std::nullopt : parsed(takeLast(forwarded_for));
        if (!hop) {
            break; // what a trusted proxy wrote is no address: it answers for its viewers itself
        }
        way.client = *hop;
    }
    return way;
}

} // namespace

Result<TrustedProxies> TrustedProxies::parse(const std::vector<std::string>& networks) {
    TrustedProxies proxies;
    for (const std::string& text : networks) {
        const bool whole = text.find('/') == std::string::npos;
        boost::system::error_code failure;
        const auto v4 = ip::make_network_v4(whole ? text + "/32" : text, failure);
        if (!failure) {
            proxies.networks_.emplace_back(v4.canonical());
            continue;
        }
        const auto v6 = ip::make_network_v6(whole ? text + "/128" : text, failure);
        if (failure) {
            return Error{ErrorCode::kInvalidArgument,
                         "'" + printable(text) +
                             "' is not an address or network, such as 10.0.0.0/8 or fd00::/8"};
        }
        proxies.networks_.emplace_back(v6.canonical());
    }
    return proxies;
}

bool TrustedProxies::contains(const ip::address& address) const {
    return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
        if (const auto* v4 = std::get_if<ip::network_v4>(&network)) {
            return address.is_v4() &&
                   ip::network_v4(address.to_v4(), v4->prefix_length()).canonical() == *v4;
        }
        const auto& v6 = std::get<ip::network_v6>(network);
        return address.is_v6() &&
               ip::network_v6(address.to_v6(), v6.prefix_length()).canonical() == v6;
    });
}

ip::address
clientAddress(ip::address peer, std::string_view forwarded_for, const TrustedProxies& proxies) {
    return walk(peer, forwarded_for, proxies).client;
}

bool cameByTls(const ip::address& peer,
               std::string_view forwarded_for,
               std::string_view forwarded_proto,
               const TrustedProxies& proxies) {
    const size_t trusted = walk(peer, forwarded_for, proxies).trusted_hops;
    bool encrypted = false;
    for (size_t hop = 1; !forwarded_proto.empty() && (trusted == 0 || hop <= trusted); ++hop) {
        const std::string_view proto = takeLast(forwarded_proto);
        const bool now = !iequals(proto, "http") && !iequals(proto, "ws");
        encrypted = now || (trusted == 0 && encrypted);
    }
    return encrypted;
}

Caller callerAt(const ip::address& address) {
    const ip::address where = plain(address);
    const bool local = where == ip::address_v4::loopback() || where == ip::address_v6::loopback();
    if (where.is_v4() || local) {
        return {{where.to_string()}, local, {}};
    }
    ip::address_v6 host = where.to_v6();
    host.scope_id(0);
    return {{ip::network_v6(host, kAccountBits).canonical().to_string()}, false, {}};
}

} // namespace froxel::net
