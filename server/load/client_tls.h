// TLS on the viewer's side.
#pragma once

#include "core/error.h"

#include <boost/asio/ssl/context.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace froxel::load {

// Trusts who is signed by a certificate of `authorities` (PEM), by default by one of the system's.
// Errors: kIo, naming the file.
[[nodiscard]] Result<std::shared_ptr<boost::asio::ssl::context>>
clientTls(const std::filesystem::path& authorities);

// Before the handshake: the server is to prove that it is `host`, a name or an address. False: this
// cannot be checked, and the connection must not be used.
[[nodiscard]] bool expectHost(SSL* tls, const std::string& host);

// After a handshake that failed, in one line.
[[nodiscard]] std::string whyRefused(SSL* tls, const boost::system::error_code& failure);

} // namespace froxel::load
