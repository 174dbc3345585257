// A viewer's way in: address, TCP, TLS, WebSocket, Hello.
#include "core/text.h"
#include "load/client_tls.h"
#include "load/viewer.h"
#include "protocol/limits.h"

#include <boost/asio/connect.hpp>
#include <boost/beast/http/field.hpp>

#include <utility>

namespace froxel::load {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

using namespace std::chrono_literals;

constexpr auto kConnectTimeout = 10s;
// Between the server's pings and ours a silent connection is found broken within this.
constexpr auto kIdleTimeout = 30s;

// A full server declines whoever does not say that a room of its own is meant.
std::string resourceFor(const Target& target, const std::string& room) {
    const char* separator = target.resource.find('?') == std::string::npos ? "?" : "&";
    return room.empty() ? target.resource : target.resource + separator + "room=" + room;
}

} // namespace

void Viewer::connectAt(TimePoint when) {
    deadline_.expires_at(when);
    deadline_.async_wait(guarded([](Viewer& self) { self.connect(); }));
}

void Viewer::connect() {
    connecting_since_ = Clock::now();
    deadline_.expires_after(kFirstFrameTimeout);
    deadline_.async_wait(guarded([](Viewer& self) {
        if (!self.result_.first_frame_ms) {
            self.fail("no frame within " + numberText(kFirstFrameTimeout.count()) + " s");
        }
    }));
    const auto where = [this](const std::string& why) {
        return "cannot connect to " + printable(options_.target.authority) + ": " + why;
    };
    resolver_.async_resolve(
        options_.target.host, options_.target.port,
        [self = shared_from_this(), where](Code failure, const auto& addresses) {
            if (self->ended_) {
                return;
            }
            if (failure) {
                self->fail(where(failure.message()));
                return;
            }
            CountedTcp& socket = self->tcp();
            socket.expires_after(kConnectTimeout);
            socket.async_connect(addresses, [self, where](Code broken, const auto& /*address*/) {
                if (self->ended_) {
                    return;
                }
                if (broken) {
                    self->fail(where(broken.message()));
                } else {
                    self->onConnected();
                }
            });
        });
}

void Viewer::onConnected() {
    Code ignored; // a socket that closed meanwhile fails at its first read
    tcp().socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    if (options_.target.tls) {
        secure();
    } else {
        upgrade();
    }
}

void Viewer::secure() {
    SSL* const tls = stream_.next_layer().tls();
    if (!expectHost(tls, options_.target.host)) {
        fail("TLS: no server can prove to be " + printable(options_.target.host, 200));
        return;
    }
    tcp().expires_after(kConnectTimeout);
    stream_.next_layer().async_handshake(
        asio::ssl::stream_base::client, [self = shared_from_this(), tls](Code failure) {
            if (self->ended_) {
                return;
            }
            if (failure) {
                self->fail("TLS with " + printable(self->options_.target.authority) +
                           " failed: " + whyRefused(tls, failure));
            } else {
                self->upgrade();
            }
        });
}

void Viewer::upgrade() {
    tcp().expires_never();
    stream_.set_option(websocket::stream_base::timeout{kConnectTimeout, kIdleTimeout,
                                                       /*keep_alive_pings=*/true});
    stream_.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
        request.set(
            beast::http::field::sec_websocket_protocol,
            beast::string_view(protocol::kSubprotocol.data(), protocol::kSubprotocol.size()));
    }));
    stream_.read_message_max(protocol::kMaxFrameBytes);
    stream_.binary(true);
    stream_.async_handshake(
        response_, options_.target.authority, resourceFor(options_.target, options_.room),
        [self = shared_from_this()](Code failure) {
            if (self->ended_) {
                return;
            }
            if (failure == websocket::error::upgrade_declined) {
                const bool full =
                    self->response_.result() == beast::http::status::service_unavailable;
                self->fail("no WebSocket at " + printable(self->options_.target.resource) +
                           ": HTTP " + numberText(self->response_.result_int()) +
                           (full ? ", the server is full or going down" : ""));
            } else if (failure) {
                self->fail("the WebSocket handshake failed: " + failure.message());
            } else {
                self->onUpgraded();
            }
        });
}

void Viewer::onUpgraded() {
    v1::ClientMessage message;
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    message.mutable_hello()->set_protocol_minor(protocol::kMinor);
    message.mutable_hello()->set_client_name("froxel load " + numberText(number_));
    message.mutable_hello()->add_codecs(v1::CODEC_VP9);
    message.mutable_hello()->set_room(options_.room);
    if (const auto& tokens = options_.tokens; !tokens.empty()) {
        message.mutable_hello()->set_token(tokens[(number_ - 1) % tokens.size()]);
    }
    send(std::move(message), Clock::now());
    read();
}

} // namespace froxel::load
