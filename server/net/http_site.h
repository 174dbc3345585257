// What one address answers over HTTP, as a connection sees it: the public one (public_site.h) and
// the one for operators (admin_site.h). Immutable; any thread.
#pragma once

#include "core/encoded_frame.h"
#include "net/connection_tickets.h"
#include "net/host_names.h"
#include "net/long_work.h"
#include "net/paced_reads.h"
#include "net/service.h"
#include "transport/peer_stream.h"

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace froxel::net {

using PacedTcp =
    boost::beast::basic_stream<boost::asio::ip::tcp, boost::asio::any_io_executor, PacedReads>;
using PeerStream = transport::PeerStream<PacedTcp>;
using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

} // namespace froxel::net

extern template class froxel::transport::PeerStream<froxel::net::PacedTcp>;

namespace froxel::net {

// What comes later than an answer may. Its body is the picture, which is let go when it is sent;
// where there is none, the response's own.
struct LateAnswer {
    Response response;
    SharedBytes picture{};
    // Told when the picture's bytes begin to be sent, and how the connection is closed, which they
    // may have to go for; none: nobody wants to know.
    std::function<void(std::function<void()> close)> sending{};
};

// Takes the body of a request as it comes. One strand; ends before it is complete where the
// connection does.
class RequestBody {
  public:
    RequestBody() = default;
    virtual ~RequestBody() = default;
    RequestBody(const RequestBody&) = delete;
    RequestBody& operator=(const RequestBody&) = delete;

    // The next bytes, in their order. Not none: why no more are wanted.
    [[nodiscard]] virtual std::optional<Response> take(std::span<const std::byte> bytes) = 0;
    // All have come: as HttpSite::answerLater().
    [[nodiscard]] virtual std::function<void()> complete(std::function<void(LateAnswer)> done) = 0;
    // Whether both wait for a disk: they are called where that keeps nobody.
    [[nodiscard]] virtual bool waits() const { return false; }
};

[[nodiscard]] inline std::string_view viewOf(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

class HttpSite {
  public:
    virtual ~HttpSite() = default;

    // By which names it is asked.
    [[nodiscard]] virtual const HostNames& hostNames() const = 0;
    // The methods that this path has, as the field Allow lists them.
    [[nodiscard]] virtual std::string_view methodsOf(std::string_view /*path*/) const {
        return "GET, HEAD";
    }
    // One of these; `path` is without the query.
    [[nodiscard]] virtual Response answer(const Request& request,
                                          std::string_view path,
                                          const boost::asio::ip::address& peer) const = 0;
    // How long a request of `peer` has to wait, since there were too many before it: it is refused
    // after that. 0 s: it is answered.
    [[nodiscard]] virtual Seconds waitOf(const Request& /*request*/,
                                         const boost::asio::ip::address& /*peer*/) const {
        return Seconds(0);
    }
    // One of these, of what takes longer than an answer may: `done` gets it once, on any thread and
    // maybe within. What comes back calls it off, on any thread. None: answer() has it.
    using CallOff = std::function<void()>;
    [[nodiscard]] virtual std::optional<CallOff>
    answerLater(const Request& /*request*/,
                std::string_view /*path*/,
                const boost::asio::ip::address& /*peer*/,
                std::function<void(LateAnswer)> /*done*/) const {
        return {};
    }
    // Whether a request of this method may have a body.
    [[nodiscard]] virtual bool takesBody(boost::beast::http::verb /*method*/,
                                         std::string_view /*path*/) const {
        return false;
    }
    // What takes the body of such a request, of so many bytes, or why it must not come.
    using Received = std::variant<Response, std::unique_ptr<RequestBody>>;
    [[nodiscard]] virtual Received receive(const Request& request,
                                           std::string_view path,
                                           const boost::asio::ip::address& peer,
                                           uint64_t size_bytes) const;
    // Where bodies that wait are taken; null: there are none. Outlives every connection.
    [[nodiscard]] virtual LongWork* longWork() const { return nullptr; }
    // Why this request of `peer` may not become a WebSocket; none when it may. Asked of a plain GET
    // of its path, too: a browser's page is told no status of a WebSocket that was refused.
    [[nodiscard]] virtual std::optional<Response>
    refuseUpgrade(const Request& request, const boost::asio::ip::address& peer) const = 0;
    // Connections that the account of `peer` may have at once.
    [[nodiscard]] virtual uint32_t connectionsMax(const boost::asio::ip::address& /*peer*/) const {
        return std::numeric_limits<uint32_t>::max();
    }
    // Takes the connection over; only after refuseUpgrade() gave none.
    virtual void upgrade(PeerStream stream, Request request, ConnectionTicket ticket) const = 0;
    // One over the limit was closed unanswered.
    virtual void onConnectionRefused() const = 0;
    // Connections close when this drains; null: they are answered until the process ends.
    [[nodiscard]] virtual Service* drainsWith() const = 0;
};

// Of the other end; unspecified where that is gone.
[[nodiscard]] boost::asio::ip::address peerAddress(const PeerStream& stream);
// Why a request is answered by neither, whatever it asks for: its Host is none of the site's names.
[[nodiscard]] std::optional<Response> refuseHost(const Request& request, const HttpSite& site);

// The path of a request's target, without the query.
[[nodiscard]] std::string_view pathOf(const Request& request);

// Whether its method is one of HttpSite::methodsOf().
[[nodiscard]] bool isOneOf(const Request& request, std::string_view methods);

// The whole answer to a request that is no upgrade: methods that its path has go to the site, HEAD
// gets the headers of GET, and every answer the headers that keep browsers out of trouble.
[[nodiscard]] Response
respond(const Request& request, const HttpSite& site, const boost::asio::ip::address& peer);
// The same of what answerLater() gave.
[[nodiscard]] LateAnswer finished(const Request& request, LateAnswer answer);

// For answer(): a body of this type, and one line of text.
[[nodiscard]] Response
makeResponse(boost::beast::http::status status, std::string_view content_type, std::string body);
[[nodiscard]] Response textResponse(boost::beast::http::status status, std::string line);

// What HTTP clients that are programs are told where they get something else: JSON with these.
struct ApiRefusal {
    std::string code;  // as of the protocol's errors: "out_of_range"
    std::string field; // of the request; empty: none
    std::string message;
    std::string fits{}; // the largest that would do, as the field has it; empty: unknown
};
[[nodiscard]] Response apiRefusal(boost::beast::http::status status, const ApiRefusal& refusal);
// A file may have any name: what of a text is no UTF-8 is replaced.
[[nodiscard]] std::string textOf(const nlohmann::ordered_json& json);

// Whether the request has something already of whatever is answered: If-None-Match: *.
[[nodiscard]] bool hasAnything(const Request& request);

// The tag of what is a function of this text alone.
[[nodiscard]] std::string etagOf(const std::string& text);
// Whether who asks has what this tag is of already (If-None-Match).
[[nodiscard]] bool hasAlready(const Request& request, std::string_view etag);
// A body that has this tag, or 304 and none to who has it already (If-None-Match).
[[nodiscard]] Response taggedResponse(const Request& request,
                                      std::string_view content_type,
                                      const std::string& body,
                                      const std::string& etag);

// The token that a request shows, RFC 6750 section 2.1; empty: none.
[[nodiscard]] std::string_view bearerToken(const Request& request);
// To one without it.
[[nodiscard]] Response unauthorized(std::string line);

// What a browser may do with the page: its own scripts and worker, its own socket, pictures made in
// memory, and the WebSocket of `reconnect_url` unless that is empty.
[[nodiscard]] std::string contentPolicy(std::string_view reconnect_url);

// An error with one line of text for a person; closes the connection.
[[nodiscard]] Response refusal(boost::beast::http::status status, std::string line);

} // namespace froxel::net
