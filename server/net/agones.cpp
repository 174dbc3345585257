#include "net/agones.h"

#include "core/text.h"
#include "core/thread_name.h"
#include "net/agones_plan.h"
#include "net/guard.h"
#include "net/sdk_request.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <array>
#include <future>
#include <thread>
#include <utility>

namespace froxel::net {

namespace asio = boost::asio;

namespace {

// How often the server is looked at: a session may go unnoticed for so long.
constexpr std::chrono::milliseconds kLook{250};
constexpr std::chrono::seconds kAnswer{2};
constexpr std::chrono::seconds kLastAnswer{2};

} // namespace

struct Agones::Impl {
    Impl(const AgonesOptions& from, AgonesHooks asked)
        : options(from), hooks(std::move(asked)), plan(options.sessions_max) {
        look();
        thread = std::jthread([this] {
            nameThread("agones");
            while (!guarded("agones thread", [this] { io.run(); })) {
            }
        });
    }
    ~Impl() { io.stop(); }

    void look() {
        timer.expires_after(kLook);
        timer.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                look();
                step();
            }
        });
    }

    [[nodiscard]] AgonesNews news() const {
        const ServiceStatus status = hooks.status();
        return {status.serving.has_value(), status.draining.has_value(), over,
                static_cast<uint32_t>(hooks.session_count())};
    }

    // One request at a time.
    void step() {
        if (request || ended) {
            return;
        }
        auto call = plan.next(news(), Clock::now());
        if (call && call->topic == AgonesTopic::kHealth && !hooks.live()) {
            plan.skipHealth(Clock::now()); // silence says it; what else is due comes after
            call = plan.next(news(), Clock::now());
        }
        if (call) {
            send(*call);
        } else if (plan.saidEnd()) {
            ended = true;
            timer.cancel();
            told_end.set_value();
        }
    }

    void send(const AgonesCall& call) {
        request = std::make_shared<SdkRequest>(io, options.port, call.method, call.path, call.body);
        request->start(kAnswer, [this, call](const Result<unsigned>& status) {
            request.reset();
            if (!std::exchange(dropped, false)) {
                onAnswer(call, status);
            }
            step();
        });
    }

    void onAnswer(const AgonesCall& call, const Result<unsigned>& status) {
        const bool accepted = status && *status >= 200 && *status < 300;
        if (accepted) {
            plan.onAccepted(call, Clock::now());
        } else {
            plan.onFailed(call, Clock::now());
        }
        // One line when nobody answers any more, and one when somebody does again.
        if (!status && !std::exchange(lost, true)) {
            spdlog::warn("event=agones_lost port={} reason={}", options.port,
                         logValue(status.error().message));
        }
        if (status && std::exchange(lost, false)) {
            spdlog::info("event=agones_back port={}", options.port);
        }
        if (status) {
            tellVerdict(call, *status, accepted);
        }
    }

    // The same of what is refused, such as a counter that the fleet does not have.
    void tellVerdict(const AgonesCall& call, unsigned status, bool accepted) {
        const bool before = std::exchange(refused[static_cast<size_t>(call.topic)], !accepted);
        if (!accepted && !before) {
            spdlog::warn("event=agones_refused path={} status={}", call.path, status);
        } else if (accepted && (before || call.topic == AgonesTopic::kState)) {
            spdlog::info("event=agones_accepted path={}", call.path);
        }
    }

    void end() {
        over = true;
        plan.retryNow();
        if (request) {
            dropped = true;
            request->cancel();
        } else {
            step();
        }
    }

    const AgonesOptions options;
    const AgonesHooks hooks;
    AgonesPlan plan;
    asio::io_context io{1};
    asio::steady_timer timer{io};
    std::shared_ptr<SdkRequest> request; // under way
    bool dropped = false;                // its answer does not matter any more
    bool over = false;
    bool ended = false;
    bool lost = false;
    std::array<bool, kAgonesTopics> refused{};
    std::promise<void> told_end;
    std::jthread thread; // last: it ends before what it uses
};

Agones::Agones(const AgonesOptions& options, AgonesHooks hooks)
    : impl_(std::make_unique<Impl>(options, std::move(hooks))) {}

Agones::~Agones() = default;

void Agones::shutDown() {
    auto told = impl_->told_end.get_future();
    asio::post(impl_->io, [impl = impl_.get()] { impl->end(); });
    if (told.wait_for(kLastAnswer) != std::future_status::ready) {
        spdlog::warn("event=agones_not_told path=/shutdown port={}", impl_->options.port);
    }
}

} // namespace froxel::net
