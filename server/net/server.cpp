#include "net/server.h"

#include "core/thread_name.h"
#include "net/admin_site.h"
#include "net/guard.h"
#include "net/health.h"
#include "net/listener.h"
#include "net/public_site.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include <algorithm>
#include <future>
#include <thread>
#include <utility>

namespace froxel::net {

namespace asio = boost::asio;

namespace {

constexpr uint32_t kAdminConnectionsMax = 32;
constexpr std::chrono::seconds kNetworkAnswer{1};
// Of a deadline, for closing who is still there: a fifth of it, and at most this.
constexpr std::chrono::milliseconds kClosingTime{1000};
constexpr std::chrono::milliseconds kLeastClosingTime{500};
constexpr std::chrono::seconds kLastWords{1};
// How often the store looks for what is too old.
constexpr std::chrono::seconds kStoreLook{60};

std::shared_ptr<const Site> makeSite(const ServerOptions& options, LongWork& long_work) {
    auto site = std::make_shared<Site>();
    if (!options.web_root.empty()) {
        site->files = StaticFiles::load(options.web_root).value();
    }
    site->host_names = HostNames(options.host_names, options.bind.address);
    site->allowed_origins = options.allowed_origins;
    site->encrypted = options.tls != nullptr;
    site->gate = options.gate;
    site->shows_elsewhere =
        !options.gate && (!isLoopback(options.bind.address) || !options.host_names.empty());
    site->connections_per_address = std::max(1U, options.connections_max / 2);
    site->trusted_proxies = TrustedProxies::parse(options.trusted_proxies).value();
    site->content_policy = contentPolicy(options.reconnect_url);
    site->service = std::make_shared<Service>();
    site->lobby = std::make_shared<Lobby>(options.lobby);
    site->metrics = std::make_shared<Metrics>(
        options.version, [lobby = site->lobby] { return lobby->sessionCount(); });
    site->request_limits = std::make_shared<RequestLimits>();
    site->scenes = std::make_shared<const SceneListing>(options.catalogue, site->service);
    site->still_desk = std::make_shared<still::StillDesk>(options.stills);
    site->stills = std::make_shared<StillAnswers>(site->still_desk, options.catalogue,
                                                  site->service, long_work);
    site->guest_bodies = std::make_shared<GuestBodies>(options.guests, options.guest_body_bytes);
    site->uploads = std::make_shared<const Uploads>(options.guest_store, long_work);
    site->service->subscribe(site->stills);
    site->metrics->watchStills([desk = site->still_desk] { return desk->counts(); });
    site->long_work = &long_work;
    return site;
}

// Calls `on_due` when that is due, on a strand of its own.
class Alarm {
  public:
    Alarm(asio::io_context& io, std::function<void()> on_due)
        : timer_(asio::make_strand(io)), on_due_(std::move(on_due)) {}

    // Any thread.
    void set(TimePoint due) {
        asio::post(timer_.get_executor(), [this, due] { wait(due); });
    }
    // None comes any more: a timer that waits would keep the threads from ending.
    void stop() {
        asio::post(timer_.get_executor(), [this] {
            stopped_ = true;
            timer_.cancel();
        });
    }

  private:
    // On the strand.
    void wait(TimePoint due) {
        if (stopped_ || (expires_at_ && *expires_at_ <= due)) {
            return;
        }
        expires_at_ = due;
        timer_.expires_at(due);
        timer_.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                expires_at_.reset();
                on_due_();
            }
        });
    }

    asio::steady_timer timer_;
    const std::function<void()> on_due_;
    std::optional<TimePoint> expires_at_;
    bool stopped_ = false;
};

// The admin address, on a thread of its own: whatever viewers do, it answers.
struct Admin {
    Admin(const BindAddress& bind, std::shared_ptr<const AdminSite> site)
        : listener(std::make_shared<Listener>(
              io, bind, "--admin-bind", kAdminConnectionsMax, std::move(site))) {
        listener->start();
        thread = std::jthread([this] {
            nameThread("admin");
            runGuarded("network thread", io);
        });
    }
    ~Admin() { io.stop(); }

    asio::io_context io{1};
    const std::shared_ptr<Listener> listener;
    std::jthread thread; // last: it ends before what it uses
};

} // namespace

struct Server::Impl {
    explicit Impl(const ServerOptions& options)
        : reconnect_url(options.reconnect_url), io(static_cast<int>(options.thread_count)),
          long_work(options.thread_count), site(makeSite(options, long_work)),
          listener(std::make_shared<Listener>(io,
                                              options.bind,
                                              "--port",
                                              options.connections_max,
                                              std::make_shared<PublicSite>(site),
                                              options.tls)),
          lobby_alarm(io, [this] { site->lobby->expire(Clock::now()); }),
          still_alarm(io,
                      [this] {
                          site->stills->expire(Clock::now());
                          site->still_desk->expire(Clock::now());
                      }),
          store_alarm(io, [this, store = options.guest_store] {
              long_work.post([store] { (void)store->expire(std::chrono::system_clock::now()); });
              store_alarm.set(Clock::now() + kStoreLook);
          }) {
        if (!options.admin.address.empty()) {
            const std::string& address = options.admin.address;
            admin.emplace(options.admin,
                          std::make_shared<AdminSite>(
                              site->metrics, site->service,
                              AdminHooks{[this] { return moves(); }, options.on_drain_request,
                                         [lobby = site->lobby](const std::string& room) {
                                             return lobby->takeControl(room);
                                         }},
                              AdminAccess{HostNames(options.host_names, address),
                                          isLoopback(address), options.admin_gate}));
        }
        if (options.guest_store) {
            site->metrics->watchUploads([store = options.guest_store] { return store->counts(); });
            store_alarm.set(Clock::now() + kStoreLook);
        }
        site->lobby->setAlarm([this](TimePoint due) { lobby_alarm.set(due); });
        site->still_desk->setAlarm([this](TimePoint due) { still_alarm.set(due); });
        site->stills->setAlarm([this](TimePoint due) { still_alarm.set(due); });
        if (options.agones) {
            agones.emplace(*options.agones, hooksForAgones());
        }
        listener->start();
        for (uint32_t i = 0; i < options.thread_count; ++i) {
            std::packaged_task<void()> task([this] {
                nameThread("network");
                runGuarded("network thread", io);
            });
            done.push_back(task.get_future());
            threads.emplace_back(std::move(task));
        }
    }
    ~Impl() {
        agones.reset();
        io.stop();
        threads.clear();
        site->lobby->close(); // connections that end with `io` set off no alarm
        site->still_desk->close();
        site->stills->close();
    }

    AgonesHooks hooksForAgones() {
        return {[this] { return site->service->status(); },
                [this] {
                    return isLive(
                               site->service->status(), [this] { return moves(); }, Clock::now())
                        .has_value();
                },
                [this] { return site->lobby->sessionCount(); }};
    }

    // Whether a network thread takes work that it is given now.
    bool moves() {
        auto moved = std::make_shared<std::promise<void>>();
        const auto answer = moved->get_future();
        asio::post(io, [moved] { moved->set_value(); });
        return answer.wait_for(kNetworkAnswer) == std::future_status::ready;
    }

    void stopWaiting() {
        site->lobby->close();
        lobby_alarm.stop();
        still_alarm.stop();
        store_alarm.stop();
    }

    const std::string reconnect_url;
    asio::io_context io;
    LongWork long_work;
    const std::shared_ptr<const Site> site;
    const std::shared_ptr<Listener> listener;
    Alarm lobby_alarm;
    Alarm still_alarm;
    Alarm store_alarm;
    std::optional<Admin> admin;
    std::optional<Agones> agones;
    std::vector<std::future<void>> done;
    std::vector<std::jthread> threads; // last: they end before what they use
};

Server::Server(const ServerOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Server::~Server() = default;

uint16_t Server::port() const {
    return impl_->listener->port();
}

std::optional<uint16_t> Server::adminPort() const {
    return impl_->admin ? std::optional(impl_->admin->listener->port()) : std::nullopt;
}

Service& Server::service() {
    return *impl_->site->service;
}

Metrics& Server::metrics() {
    return *impl_->site->metrics;
}

bool Server::drain(std::chrono::milliseconds deadline) {
    const TimePoint end = Clock::now() + deadline;
    Draining draining{deadline - std::min(kClosingTime, deadline / 5), impl_->reconnect_url, false};
    const TimePoint over = Clock::now() + draining.deadline;
    impl_->site->service->setDraining(draining);
    impl_->stopWaiting();
    static_cast<void>(impl_->site->lobby->waitUntilEmpty(over));

    impl_->listener->stop();
    draining.over = true;
    impl_->site->service->setDraining(std::move(draining));
    // The threads end by themselves when no connection is left.
    const TimePoint closed_by = std::max(end, Clock::now() + kLeastClosingTime);
    const bool all_closed =
        std::all_of(impl_->done.begin(), impl_->done.end(), [&](const auto& done) {
            return done.wait_until(closed_by) == std::future_status::ready;
        });
    if (impl_->agones) {
        impl_->agones->shutDown();
    }
    return all_closed;
}

void Server::giveUp(const std::string& why) {
    impl_->site->service->setLost(why);
    impl_->stopWaiting();
    static_cast<void>(impl_->site->lobby->waitUntilEmpty(Clock::now() + kLastWords));
}

} // namespace froxel::net
