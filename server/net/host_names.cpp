#include "net/host_names.h"

#include <boost/asio/ip/address.hpp>

#include <algorithm>
#include <utility>

namespace froxel::net {

namespace {

std::string plainName(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (name.ends_with('.')) {
        name.pop_back();
    }
    return name;
}

} // namespace

std::string hostIn(const boost::urls::authority_view& authority) {
    using boost::urls::host_type;
    switch (authority.host_type()) {
    case host_type::none:
        return {};
    case host_type::ipv4:
        return authority.host_ipv4_address().to_string();
    case host_type::ipv6:
        return authority.host_ipv6_address().to_string();
    default:
        return plainName(std::string(authority.encoded_host()));
    }
}

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
        std::transform(names.begin(), names.end(), names.begin(), plainName);
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
    return std::find(names_->begin(), names_->end(), hostIn(*authority)) != names_->end();
}

} // namespace froxel::net
