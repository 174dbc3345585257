// The text of an address to listen on, and back.
#pragma once

#include "core/error.h"
#include "net/bind_address.h"

#include <string>

namespace froxel::app {

// "127.0.0.1:9090", "[::1]:0", or "none": an empty address. Whether the address is one of this
// machine's is found out by listening. Errors: kInvalidArgument.
[[nodiscard]] Result<net::BindAddress> parseBindAddress(const std::string& text);

// "http://127.0.0.1:9090/", with an IPv6 address in brackets.
[[nodiscard]] std::string
urlOf(const std::string& address, uint16_t port, const std::string& scheme = "http");

} // namespace froxel::app
