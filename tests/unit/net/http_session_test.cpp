#include "net/http_session.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {
namespace {

namespace ssl = boost::asio::ssl;
using boost::asio::ip::tcp;

ConnectionTicket oneTicket() {
    return ConnectionTickets(1).take(boost::asio::ip::address_v4::loopback(), 1, Clock::now());
}

// Takes every upgrade, and has the service change while the connection is being handed over.
class ChangingSite final : public HttpSite {
  public:
    [[nodiscard]] const HostNames& hostNames() const override { return any_; }
    [[nodiscard]] Response answer(const Request& /*request*/,
                                  std::string_view /*path*/,
                                  const boost::asio::ip::address& /*peer*/) const override {
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
    std::make_shared<HttpSession>(acceptor.accept(), &server_tls, site, oneTicket())->start();

    constexpr std::string_view kUpgrade = "GET /ws HTTP/1.1\r\nHost: froxel.example\r\n"
                                          "Connection: upgrade\r\nUpgrade: websocket\r\n\r\n";
    client.async_handshake(ssl::stream_base::client, [&](boost::system::error_code error) {
        ASSERT_FALSE(error) << error.message();
        boost::asio::write(client, boost::asio::buffer(kUpgrade));
    });
    context.run();
    EXPECT_TRUE(site->taken);
}

// Answers later, when a test says so.
class PatientSite final : public HttpSite {
  public:
    [[nodiscard]] const HostNames& hostNames() const override { return any_; }
    [[nodiscard]] Response answer(const Request& /*request*/,
                                  std::string_view /*path*/,
                                  const boost::asio::ip::address& /*peer*/) const override {
        return textResponse(boost::beast::http::status::ok, "at once");
    }
    [[nodiscard]] std::optional<CallOff>
    answerLater(const Request& /*request*/,
                std::string_view path,
                const boost::asio::ip::address& /*peer*/,
                std::function<void(LateAnswer)> done) const override {
        if (path != "/later") {
            return {};
        }
        asked = std::move(done);
        return [this] { called_off = true; };
    }
    [[nodiscard]] bool takesBody(boost::beast::http::verb method,
                                 std::string_view path) const override {
        return method == boost::beast::http::verb::post && path == "/body";
    }
    [[nodiscard]] Received receive(const Request& /*request*/,
                                   std::string_view /*path*/,
                                   const boost::asio::ip::address& /*peer*/,
                                   uint64_t size_bytes) const override {
        if (size_bytes > kMostBytes) {
            return textResponse(boost::beast::http::status::payload_too_large, "too large");
        }
        return std::make_unique<Body>(*this);
    }
    [[nodiscard]] std::optional<Response>
    refuseUpgrade(const Request& /*request*/,
                  const boost::asio::ip::address& /*peer*/) const override {
        return std::nullopt;
    }
    void upgrade(PeerStream /*stream*/,
                 Request /*request*/,
                 ConnectionTicket /*ticket*/) const override {}
    void onConnectionRefused() const override {}
    [[nodiscard]] Service* drainsWith() const override { return nullptr; }

    static constexpr uint64_t kMostBytes = 1 << 20;
    mutable std::function<void(LateAnswer)> asked;
    mutable bool called_off = false;
    mutable std::string received; // of bodies
    mutable int bodies = 0;       // that there are

  private:
    class Body final : public RequestBody {
      public:
        explicit Body(const PatientSite& site) : site_(site) { ++site_.bodies; }
        ~Body() override { --site_.bodies; }
        std::optional<Response> take(std::span<const std::byte> bytes) override {
            site_.received.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            return site_.received.starts_with("no")
                       ? std::optional(
                             textResponse(boost::beast::http::status::bad_request, "not this"))
                       : std::nullopt;
        }
        CallOff complete(std::function<void(LateAnswer)> done) override {
            site_.asked = std::move(done);
            return [&site = site_] { site.called_off = true; };
        }

      private:
        const PatientSite& site_;
    };
    const HostNames any_{};
};

class LateAnswerTest : public testing::Test {
  protected:
    LateAnswerTest() {
        client_.connect(acceptor_.local_endpoint());
        std::make_shared<HttpSession>(acceptor_.accept(), nullptr, site_, oneTicket())->start();
    }
    // What was asked last holds the session, which holds the site.
    ~LateAnswerTest() override { site_->asked = nullptr; }
    void send(std::string_view path) {
        boost::asio::write(client_, boost::asio::buffer("GET " + std::string(path) +
                                                        " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
    }
    void post(size_t size_bytes, std::string_view fields, std::string_view body) {
        boost::asio::write(client_,
                           boost::asio::buffer("POST /body HTTP/1.1\r\nHost: localhost\r\n" +
                                               std::string(fields) +
                                               "Content-Length: " + std::to_string(size_bytes) +
                                               "\r\n\r\n" + std::string(body)));
    }
    template <class Condition>
    void runUntil(const Condition& condition) {
        while (!condition()) {
            ASSERT_GT(context_.run_one(), 0U) << "nothing is left to do";
        }
    }
    std::string received(std::string_view end) {
        std::string text;
        runUntil([&] {
            std::array<char, 1024> part{};
            boost::system::error_code none;
            const size_t bytes =
                client_.available() > 0 ? client_.read_some(boost::asio::buffer(part), none) : 0;
            text.append(part.data(), bytes);
            return text.ends_with(end);
        });
        return text;
    }

    boost::asio::io_context context_;
    tcp::acceptor acceptor_{context_, {boost::asio::ip::address_v4::loopback(), 0}};
    tcp::socket client_{context_};
    const std::shared_ptr<PatientSite> site_ = std::make_shared<PatientSite>();
};

TEST_F(LateAnswerTest, IsSentWhenItIsThere_AndTheConnectionGoesOn) {
    send("/later");
    runUntil([&] { return site_->asked != nullptr; });
    send("/now"); // ahead of its answer
    site_->asked({textResponse(boost::beast::http::status::ok, "here")});
    const std::string text = received("at once\n");
    EXPECT_LT(text.find("here\n"), text.find("at once\n"));
    EXPECT_FALSE(site_->called_off);
}

TEST_F(LateAnswerTest, Picture_IsLetGoWhenItIsSent) {
    send("/later");
    runUntil([&] { return site_->asked != nullptr; });
    const std::string text = "a picture's bytes";
    const auto bytes = std::as_bytes(std::span(text));
    auto picture = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
    const std::weak_ptr<const std::vector<std::byte>> held = picture;
    site_->asked({textResponse(boost::beast::http::status::ok, ""), std::move(picture)});
    EXPECT_FALSE(held.expired());
    const std::string answer = received(text);
    EXPECT_NE(answer.find("Content-Length: 17\r\n"), std::string::npos) << answer;
    runUntil([&] { return held.expired(); });
    send("/now");
    EXPECT_TRUE(received("at once\n").ends_with("at once\n"));
}

TEST_F(LateAnswerTest, PictureOfAHead_IsNotSent) {
    boost::asio::write(client_, boost::asio::buffer(std::string(
                                    "HEAD /later HTTP/1.1\r\nHost: localhost\r\n\r\n")));
    runUntil([&] { return site_->asked != nullptr; });
    site_->asked({textResponse(boost::beast::http::status::ok, ""),
                  std::make_shared<const std::vector<std::byte>>(17, std::byte{'x'})});
    const std::string answer = received("\r\n\r\n");
    EXPECT_NE(answer.find("Content-Length: 17\r\n"), std::string::npos) << answer;
    send("/now");
    EXPECT_TRUE(received("at once\n").starts_with("HTTP/1.1 200"));
}

TEST_F(LateAnswerTest, ToWhoHasGone_IsCalledOff) {
    send("/later");
    runUntil([&] { return site_->asked != nullptr; });
    client_.close();
    runUntil([&] { return site_->called_off; });
    site_->asked({textResponse(boost::beast::http::status::ok, "to nobody")});
}

TEST_F(LateAnswerTest, Body_ComesInParts_AndTheConnectionGoesOn) {
    const std::string body(300'000, 'b'); // of several parts
    post(body.size(), "", body.substr(0, 1));
    runUntil([&] { return site_->received.size() == 1; });
    EXPECT_EQ(site_->asked, nullptr);
    boost::asio::write(client_, boost::asio::buffer(body.substr(1)));
    runUntil([&] { return site_->asked != nullptr; });
    EXPECT_EQ(site_->received, body);
    EXPECT_EQ(site_->bodies, 0);
    site_->asked({textResponse(boost::beast::http::status::ok, "drawn")});
    EXPECT_TRUE(received("drawn\n").starts_with("HTTP/1.1 200"));
    send("/now");
    EXPECT_TRUE(received("at once\n").starts_with("HTTP/1.1 200"));
}

TEST_F(LateAnswerTest, BodyThatIsTooLarge_IsRefusedBeforeItComes) {
    post(PatientSite::kMostBytes + 1, "Expect: 100-continue\r\n", "");
    const std::string answer = received("too large\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 413")) << answer;
    EXPECT_NE(answer.find("Connection: close\r\n"), std::string::npos) << answer;
}

TEST_F(LateAnswerTest, BodyThatIsExpectedToContinue_IsAskedFor) {
    post(4, "Expect: 100-continue\r\n", "");
    EXPECT_EQ(received("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
    boost::asio::write(client_, boost::asio::buffer(std::string("body")));
    runUntil([&] { return site_->asked != nullptr; });
    EXPECT_EQ(site_->received, "body");
    site_->asked({textResponse(boost::beast::http::status::ok, "drawn")});
    EXPECT_TRUE(received("drawn\n").starts_with("HTTP/1.1 200"));
}

TEST_F(LateAnswerTest, OtherExpectations_AreNotMet) {
    post(4, "Expect: the-unexpected\r\n", "");
    EXPECT_TRUE(received("100-continue\n").starts_with("HTTP/1.1 417"));
}

TEST_F(LateAnswerTest, BodyThatIsNotWanted_EndsTheConnection) {
    post(1000, "", "no");
    const std::string answer = received("not this\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400")) << answer;
    EXPECT_NE(answer.find("Connection: close\r\n"), std::string::npos) << answer;
    EXPECT_EQ(site_->bodies, 0);
}

// At each byte of it.
TEST_F(LateAnswerTest, ConnectionLostWithinABody_LetsGoOfIt) {
    for (size_t came = 0; came < 8; ++came) {
        site_->received.clear();
        post(8, "", std::string(came, 'b'));
        runUntil([&] { return site_->bodies == 1 && site_->received.size() == came; });
        client_.close();
        runUntil([&] { return site_->bodies == 0; });
        EXPECT_EQ(site_->asked, nullptr);
        client_ = tcp::socket(context_);
        client_.connect(acceptor_.local_endpoint());
        std::make_shared<HttpSession>(acceptor_.accept(), nullptr, site_, oneTicket())->start();
    }
}

TEST_F(LateAnswerTest, WhoGoesAfterTheBody_CallsItOff) {
    post(4, "", "body");
    runUntil([&] { return site_->asked != nullptr; });
    client_.close();
    runUntil([&] { return site_->called_off; });
}

TEST_F(LateAnswerTest, GivenTwice_IsSentOnce) {
    send("/later");
    runUntil([&] { return site_->asked != nullptr; });
    site_->asked({textResponse(boost::beast::http::status::ok, "here")});
    site_->asked({textResponse(boost::beast::http::status::ok, "again")});
    send("/now");
    EXPECT_EQ(received("at once\n").find("again"), std::string::npos);
}

} // namespace
} // namespace froxel::net
