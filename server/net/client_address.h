// From which address a viewer comes, also where proxies stand between. Pure.
#pragma once

#include "core/error.h"
#include "net/caller.h"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/network_v4.hpp>
#include <boost/asio/ip/network_v6.hpp>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace froxel::net {

// Proxies whose X-Forwarded-For is believed.
class TrustedProxies {
  public:
    // Each "10.0.0.0/8", "fd00::/8" or one address. Errors: kInvalidArgument, quoting it.
    [[nodiscard]] static Result<TrustedProxies> parse(const std::vector<std::string>& networks);

    [[nodiscard]] bool contains(const boost::asio::ip::address& address) const;

  private:
    using Network = std::variant<boost::asio::ip::network_v4, boost::asio::ip::network_v6>;
    std::vector<Network> networks_;
};

// The peer, or, behind trusted proxies, the last address of `forwarded_for` (all lines of the
// header, joined by commas) that is none of theirs: whoever is before it may have written the rest.
// IPv4 in IPv6 is IPv4.
[[nodiscard]] boost::asio::ip::address clientAddress(boost::asio::ip::address peer,
                                                     std::string_view forwarded_for,
                                                     const TrustedProxies& proxies);

// Whether the viewer's own connection is encrypted as far as `forwarded_proto` knows (likewise): by
// the outermost hop that a trusted proxy wrote, or by any where none is trusted. What is neither
// http nor ws counts as encrypted, which lets fewer pages in. None was sent: it is not.
[[nodiscard]] bool cameByTls(const boost::asio::ip::address& peer,
                             std::string_view forwarded_for,
                             std::string_view forwarded_proto,
                             const TrustedProxies& proxies);

// Of IPv6 the first 64 bits: a household or a rented machine has as many addresses as that leaves.
[[nodiscard]] Caller callerAt(const boost::asio::ip::address& address);

} // namespace froxel::net
