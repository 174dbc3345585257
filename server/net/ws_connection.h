// One WebSocket: moves messages between the socket and a Conversation, one write at a time, with
// a deadline for everything. Frames come from encoder threads and are posted to its strand.
#pragma once

#include "net/conversation.h"
#include "net/http_site.h"
#include "net/site.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <memory>
#include <optional>
#include <string>

namespace froxel::net {

class WsConnection final : public SessionViewer,
                           public ServiceListener,
                           public std::enable_shared_from_this<WsConnection> {
  public:
    WsConnection(PeerStream stream, std::shared_ptr<const Site> site, ConnectionTicket ticket);
    ~WsConnection() override;
    WsConnection(const WsConnection&) = delete;
    WsConnection& operator=(const WsConnection&) = delete;

    // `upgrade` is the request that asked for it, `caller` who sent it. On the connection's strand.
    void start(Request upgrade, Caller caller);

    void tell(Notice notice) override;
    void onServiceChanged() override;

  private:
    // What is sent is compressed already: no permessage-deflate.
    using Stream = boost::beast::websocket::stream<PeerStream, false>;
    using ErrorCode = boost::beast::error_code;
    static constexpr uint16_t kNoCloseCode = 1006; // RFC 6455 section 7.4.1

    template <class Work>
    void onStrand(Work work);
    template <class Work>
    void run(const Work& work);
    template <class Work, class Then>
    void aside(Work work, Then then);
    [[nodiscard]] PacedReads& reads() {
        return boost::beast::get_lowest_layer(stream_).rate_policy();
    }
    void setOptions();
    void onAccepted();
    void onReadError(ErrorCode error);
    void read();
    void onRead(ErrorCode error);
    void onHandled(bool was_greeted);
    void write();
    void send();
    void onWritten(ErrorCode error);
    void writeLater();
    void armWriteDeadline(size_t bytes);
    void linger();
    void closeSocket();
    void onClosed();
    // `code` is the close code that both sides know of, or what stands for it.
    void abandon(const std::string& why, uint16_t code = kNoCloseCode);

    Stream stream_;
    const std::shared_ptr<const Site> site_;
    const ConnectionTicket ticket_;
    const std::string peer_;
    Request upgrade_;
    std::optional<Conversation> conversation_; // from start() until the connection ends
    boost::asio::steady_timer hello_deadline_;
    boost::asio::steady_timer write_deadline_;
    boost::asio::steady_timer later_; // what waits for its time is written then
    boost::beast::flat_buffer buffer_;
    std::optional<Outgoing> writing_;
    bool closing_ = false;   // the close handshake was begun
    bool lingering_ = false; // nothing more can be written; the read in progress ends it
};

} // namespace froxel::net
