// The certificate that a server shows, from files that may be replaced while it runs. Any thread.
#pragma once

#include "core/error.h"

#include <boost/asio/ssl/context.hpp>

#include <filesystem>
#include <memory>
#include <mutex>

namespace froxel::net {

class Tls {
  public:
    // PEM: the certificate with its chain, and its key. Throws StartupError as reload().
    Tls(std::filesystem::path certificate, std::filesystem::path key);

    // Reads both again, for connections from now on. An error (kIo) names the file and changes
    // nothing.
    [[nodiscard]] Result<void> reload();
    // For one connection, which may outlive a reload.
    [[nodiscard]] std::shared_ptr<boost::asio::ssl::context> context() const;

  private:
    const std::filesystem::path certificate_;
    const std::filesystem::path key_;
    mutable std::mutex mutex_;
    std::shared_ptr<boost::asio::ssl::context> context_;
};

} // namespace froxel::net
