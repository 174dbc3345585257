#include "load/client_tls.h"

#include "core/text.h"

#include <boost/asio/ip/address.hpp>

#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

namespace froxel::load {
namespace ssl = boost::asio::ssl;

Result<std::shared_ptr<ssl::context>> clientTls(const std::filesystem::path& authorities) {
    auto context = std::make_shared<ssl::context>(ssl::context::tls_client);
    SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
    context->set_verify_mode(ssl::verify_peer);
    boost::system::error_code failure;
    if (authorities.empty()) {
        context->set_default_verify_paths(failure);
    } else {
        context->load_verify_file(authorities.string(), failure);
    }
    if (failure) {
        return Error{ErrorCode::kIo,
                     "TLS: " + printable(authorities.string(), 200) + ": " + failure.message()};
    }
    return context;
}

bool expectHost(SSL* tls, const std::string& host) {
    boost::system::error_code is_name;
    (void)boost::asio::ip::make_address(host, is_name);
    if (!is_name) {
        return X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(tls), host.c_str()) == 1;
    }
    return SSL_ctrl(tls, SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
                    const_cast<char*>(host.c_str())) == 1 &&
           SSL_set1_host(tls, host.c_str()) == 1;
}

std::string whyRefused(SSL* tls, const boost::system::error_code& failure) {
    const long verdict = SSL_get_verify_result(tls);
    return verdict == X509_V_OK ? failure.message() : X509_verify_cert_error_string(verdict);
}

} // namespace froxel::load
