// Which names a server answers to. A page of any site can have its own name lead to this server
// once its browser has loaded it (DNS rebinding): Origin and Host are then both that name, so they
// agree.
#pragma once

#include <boost/url/authority_view.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

class HostNames {
  public:
    // Any.
    HostNames() = default;
    // `names`, localhost and all IP addresses, which nobody can have lead elsewhere. Any at all
    // where there are no `names` and `bound_address` is not loopback: who serves others has names
    // that it is not told of.
    HostNames(std::vector<std::string> names, std::string_view bound_address);

    // `host` is a request's, with or without a port. None was sent (empty): no browser asks.
    [[nodiscard]] bool contain(std::string_view host) const;

  private:
    std::optional<std::vector<std::string>> names_; // none: any
};

// Whether `text` is a name that HostNames can have: letters, digits, dots and hyphens.
[[nodiscard]] bool isHostName(std::string_view text);

// The host of an authority in one spelling: a name in lower case and without the root's dot, an
// address as it is usually written. Empty: there is none.
[[nodiscard]] std::string hostIn(const boost::urls::authority_view& authority);

// Whether nobody but this host's own programs reach `address`.
[[nodiscard]] bool isLoopback(std::string_view address);

} // namespace froxel::net
