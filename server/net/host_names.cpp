#include "net/host_names.h"

#include <boost/asio/ip/address.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/url/authority_view.hpp>

#include <algorithm>
#include <utility>

namespace froxel::net {

bool isLoopback(std::string_view address) {
    boost::system::error_code failure;
    const auto ip = boost::asio::ip::make_address(std::string(address), failure);
    return !failure && ip.is_loopback();
}

bool isHostName(std::string_view text) {
    constexpr std::string_view kAllowed =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.-";
    constexpr size_t kMaxBytes = 253; // RFC 1035 section 2.3.4, as text
    return !text.empty() && text.size() <= kMaxBytes &&
           text.find_first_not_of(kAllowed) == std::string_view::npos;
}

HostNames::HostNames(std::vector<std::string> names, std::string_view bound_address) {
    if (!names.empty() || isLoopback(bound_address)) {
        names.emplace_back("localhost");
        names_ = std::move(names);
    }
}

bool HostNames::contain(std::string_view host) const {
    if (!names_ || host.empty()) {
        return true;
    }
    const auto authority = boost::urls::parse_authority({host.data(), host.size()});
    if (!authority || authority->has_userinfo()) {
        return false;
    }
    if (authority->host_type() != boost::urls::host_type::name) {
        return authority->host_type() != boost::urls::host_type::none;
    }
    const auto asked = authority->encoded_host();
    return std::any_of(names_->begin(), names_->end(), [&](const std::string& name) {
        return boost::beast::iequals({asked.data(), asked.size()}, name);
    });
}

} // namespace froxel::net
