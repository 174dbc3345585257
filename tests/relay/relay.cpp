#include "relay/relay.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <netinet/tcp.h>
#include <thread>
#include <utility>

namespace froxel::test {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Code = boost::system::error_code;

// Packets as on Ethernet: loopback's are of 64 KiB, and a window smaller than one of them is only
// probed now and then, so that connections would stall. Before the handshake, as both sides then
// agree on it and on the window's scale.
constexpr int kSegmentBytes = 1448;

template <class Socket>
void shape(Socket& socket) {
    using MaxSegment = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_MAXSEG>;
    socket.set_option(MaxSegment(kSegmentBytes));
    socket.set_option(asio::socket_base::receive_buffer_size(Relay::kSocketBufferBytes));
    socket.set_option(asio::socket_base::send_buffer_size(Relay::kSocketBufferBytes));
}

// Bytes that came through, for whoever waits for them.
class Counter {
  public:
    void add(uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        total_ += bytes;
        changed_.notify_all();
    }
    uint64_t total() {
        const std::lock_guard lock(mutex_);
        return total_;
    }
    bool waitFor(uint64_t bytes, std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, timeout, [&] { return total_ >= bytes; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    uint64_t total_ = 0;
};

// One direction of a connection: reads as far as the link has room, writes what arrives.
class Pump : public std::enable_shared_from_this<Pump> {
  public:
    // `owner` keeps the sockets; `cut` ends the connection.
    Pump(std::shared_ptr<void> owner,
         tcp::socket& from,
         tcp::socket& to,
         const LinkOptions& options,
         Counter& bytes,
         std::function<void()> cut)
        : owner_(std::move(owner)), from_(from), to_(to), link_(options, Clock::now()),
          timer_(from.get_executor()), bytes_(bytes), cut_(std::move(cut)) {}

    void start() { read(); }
    void setRate(double bytes_per_s) {
        link_.setRate(bytes_per_s, Clock::now());
        deliver();
    }

  private:
    void read() {
        const size_t room = std::min(link_.room(), incoming_.size());
        if (reading_ || ended_ || room == 0) {
            return;
        }
        reading_ = true;
        from_.async_read_some(asio::buffer(incoming_, room),
                              [self = shared_from_this()](Code failure, size_t size) {
                                  self->onRead(failure, size);
                              });
    }

    void onRead(Code failure, size_t size) {
        reading_ = false;
        link_.push({incoming_.data(), size}, Clock::now());
        if (failure == asio::error::eof) {
            ended_ = true; // what is on the link still arrives
        } else if (failure) {
            cut_();
            return;
        }
        deliver();
        read();
    }

    void deliver() {
        if (writing_) {
            return;
        }
        outgoing_ = link_.take(Clock::now());
        if (!outgoing_.empty()) {
            write();
        } else if (link_.empty() && ended_) {
            Code ignored;
            to_.shutdown(tcp::socket::shutdown_send, ignored);
        } else if (const auto due = link_.nextDue(Clock::now())) {
            timer_.expires_at(*due);
            timer_.async_wait([self = shared_from_this()](Code failure) {
                if (!failure) {
                    self->deliver();
                }
            });
        }
    }

    void write() {
        writing_ = true;
        timer_.cancel();
        asio::async_write(to_, asio::buffer(outgoing_),
                          [self = shared_from_this()](Code failure, size_t size) {
                              self->writing_ = false;
                              self->bytes_.add(size);
                              if (failure) {
                                  self->cut_();
                                  return;
                              }
                              self->deliver();
                              self->read();
                          });
    }

    const std::shared_ptr<void> owner_;
    tcp::socket& from_;
    tcp::socket& to_;
    ShapedLink link_;
    asio::steady_timer timer_;
    Counter& bytes_;
    const std::function<void()> cut_;
    std::array<uint8_t, 16 * 1024> incoming_{};
    std::vector<uint8_t> outgoing_;
    bool reading_ = false;
    bool writing_ = false;
    bool ended_ = false;
};

struct Sockets {
    explicit Sockets(tcp::socket accepted)
        : client(std::move(accepted)), server(client.get_executor()) {}
    void close() {
        Code ignored;
        client.close(ignored);
        server.close(ignored);
    }
    tcp::socket client;
    tcp::socket server;
};

} // namespace

struct Relay::Impl {
    explicit Impl(const RelayOptions& given) : options(given) {
        acceptor.open(tcp::v4());
        acceptor.set_option(asio::socket_base::reuse_address(true));
        shape(acceptor); // accepted sockets inherit it
        acceptor.bind({asio::ip::address_v4::loopback(), options.listen_port});
        acceptor.listen();
        tcp::resolver resolver(io);
        target = *resolver.resolve(options.host, std::to_string(options.port)).begin();
        accept();
    }

    void accept() {
        acceptor.async_accept([this](Code failure, tcp::socket socket) {
            if (!failure) {
                connect(std::make_shared<Sockets>(std::move(socket)));
                accept();
            }
        });
    }

    void connect(const std::shared_ptr<Sockets>& sockets) {
        sockets->server.open(target.protocol());
        shape(sockets->server);
        sockets->server.async_connect(target, [this, sockets](Code refused) {
            if (refused) {
                sockets->close();
                return;
            }
            Code ignored;
            sockets->server.set_option(tcp::no_delay(true), ignored);
            sockets->client.set_option(tcp::no_delay(true), ignored);
            const auto cut = [sockets] { sockets->close(); };
            auto up = std::make_shared<Pump>(sockets, sockets->client, sockets->server, options.up,
                                             up_bytes, cut);
            auto down = std::make_shared<Pump>(sockets, sockets->server, sockets->client,
                                               options.down, down_bytes, cut);
            pumps.emplace_back(up, down);
            up->start();
            down->start();
        });
    }

    RelayOptions options;
    asio::io_context io{1};
    tcp::acceptor acceptor{io};
    tcp::endpoint target;
    Counter up_bytes;
    Counter down_bytes;
    std::vector<std::pair<std::weak_ptr<Pump>, std::weak_ptr<Pump>>> pumps;
    std::thread thread;
};

Relay::Relay(const RelayOptions& options) : impl_(std::make_unique<Impl>(options)) {
    impl_->thread = std::thread([this] { impl_->io.run(); });
}

Relay::~Relay() {
    impl_->io.stop();
    impl_->thread.join();
}

uint16_t Relay::port() const {
    return impl_->acceptor.local_endpoint().port();
}

void Relay::setRate(double up_bytes_per_s, double down_bytes_per_s) {
    asio::post(impl_->io, [impl = impl_.get(), up_bytes_per_s, down_bytes_per_s] {
        impl->options.up.bytes_per_s = up_bytes_per_s;
        impl->options.down.bytes_per_s = down_bytes_per_s;
        for (const auto& [up, down] : impl->pumps) {
            if (const auto pump = up.lock()) {
                pump->setRate(up_bytes_per_s);
            }
            if (const auto pump = down.lock()) {
                pump->setRate(down_bytes_per_s);
            }
        }
    });
}

uint64_t Relay::upBytes() const {
    return impl_->up_bytes.total();
}

uint64_t Relay::downBytes() const {
    return impl_->down_bytes.total();
}

bool Relay::waitForDown(uint64_t bytes, std::chrono::milliseconds timeout) const {
    return impl_->down_bytes.waitFor(bytes, timeout);
}

} // namespace froxel::test
