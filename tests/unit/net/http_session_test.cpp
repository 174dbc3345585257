#include "net/http_session.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include <string_view>

namespace froxel::net {
namespace {

namespace ssl = boost::asio::ssl;
using boost::asio::ip::tcp;

// Takes every upgrade, and has the service change while the connection is being handed over.
class ChangingSite final : public HttpSite {
  public:
    [[nodiscard]] const HostNames& hostNames() const override { return any_; }
    [[nodiscard]] Response answer(const Request& /*request*/,
                                  std::string_view /*path*/) const override {
        return refusal(boost::beast::http::status::not_found, "nothing is here");
    }
    [[nodiscard]] std::optional<Response>
    refuseUpgrade(const Request& /*request*/,
                  const boost::asio::ip::address& /*peer*/) const override {
        return std::nullopt;
    }
    void
    upgrade(PeerStream stream, Request /*request*/, ConnectionTicket /*ticket*/) const override {
        taken = stream.next_layer().socket().is_open();
        service.setLoading({});
    }
    void onConnectionRefused() const override {}
    [[nodiscard]] Service* drainsWith() const override { return &service; }

    mutable Service service;
    mutable bool taken = false;

  private:
    const HostNames any_{};
};

// Encrypted without anybody's certificate.
ssl::context anonymous(ssl::context::method method) {
    ssl::context context(method);
    SSL_CTX_set_cipher_list(context.native_handle(), "AECDH-AES256-SHA:@SECLEVEL=0");
    return context;
}

// Of an encrypted stream that was handed over nothing is left.
TEST(HttpSessionTest, ServiceThatChangesDuringAnUpgrade_IsNoConcernOfIt) {
    boost::asio::io_context context;
    tcp::acceptor acceptor(context, {boost::asio::ip::address_v4::loopback(), 0});
    ssl::context client_tls = anonymous(ssl::context::tlsv12_client);
    ssl::stream<tcp::socket> client(context, client_tls);
    client.lowest_layer().connect(acceptor.local_endpoint());
    ssl::context server_tls = anonymous(ssl::context::tlsv12_server);
    const auto site = std::make_shared<ChangingSite>();
    std::make_shared<HttpSession>(acceptor.accept(), &server_tls, site, nullptr)->start();

    constexpr std::string_view kUpgrade = "GET /ws HTTP/1.1\r\nHost: froxel.example\r\n"
                                          "Connection: upgrade\r\nUpgrade: websocket\r\n\r\n";
    client.async_handshake(ssl::stream_base::client, [&](boost::system::error_code error) {
        ASSERT_FALSE(error) << error.message();
        boost::asio::write(client, boost::asio::buffer(kUpgrade));
    });
    context.run();
    EXPECT_TRUE(site->taken);
}

} // namespace
} // namespace froxel::net
