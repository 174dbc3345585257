#include "net/tls.h"

#include "core/text.h"

#include <openssl/ssl.h>
#include <utility>

namespace froxel::net {
namespace ssl = boost::asio::ssl;

Tls::Tls(std::filesystem::path certificate, std::filesystem::path key)
    : certificate_(std::move(certificate)), key_(std::move(key)) {
    reload().value();
}

Result<void> Tls::reload() {
    const auto refuse = [](const std::filesystem::path& file, const std::string& why) {
        return Error{ErrorCode::kIo, "TLS: " + printable(file.string(), 200) + ": " + why};
    };
    auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
    SSL_CTX* const native = context->native_handle();
    // Of TLS 1.2 only what TLS 1.3 kept: forward secrecy and authenticated encryption.
    SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
    SSL_CTX_set_cipher_list(native, "ECDHE+AESGCM:ECDHE+CHACHA20");
    SSL_CTX_set_options(native, SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION |
                                    SSL_OP_CIPHER_SERVER_PREFERENCE);
    boost::system::error_code failure;
    context->use_certificate_chain_file(certificate_.string(), failure);
    if (failure) {
        return refuse(certificate_, failure.message());
    }
    bool encrypted = false; // OpenSSL would ask at the terminal
    context->set_password_callback([&encrypted](size_t /*most*/, auto /*purpose*/) {
        encrypted = true;
        return std::string();
    });
    context->use_private_key_file(key_.string(), ssl::context::pem, failure);
    if (encrypted) {
        return refuse(key_,
                      "is encrypted; expected a key without a passphrase; openssl pkey removes it");
    }
    if (failure) {
        return refuse(key_, failure.message());
    }
    if (SSL_CTX_check_private_key(native) != 1) {
        return refuse(key_, "is not the key of " + printable(certificate_.string(), 200));
    }
    const std::lock_guard lock(mutex_);
    context_ = std::move(context);
    return {};
}

std::shared_ptr<ssl::context> Tls::context() const {
    const std::lock_guard lock(mutex_);
    return context_;
}

} // namespace froxel::net
