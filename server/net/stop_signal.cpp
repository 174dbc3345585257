#include "net/stop_signal.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>

#include <csignal>
#include <utility>

namespace froxel::net {
namespace {

void maskStopSignals(int how) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    pthread_sigmask(how, &signals, nullptr);
}

} // namespace

struct StopSignal::Impl {
    boost::asio::io_context io;
    boost::asio::signal_set signals{io, SIGTERM, SIGINT};
    boost::asio::signal_set hangups{io};
    std::function<void()> on_hangup;
    int caught = 0;

    void awaitHangup() {
        hangups.async_wait([this](boost::system::error_code failure, int) {
            if (!failure) {
                on_hangup();
                awaitHangup();
            }
        });
    }
};

void holdStopSignals() {
    maskStopSignals(SIG_BLOCK);
}

void letStopSignalsGo() {
    maskStopSignals(SIG_UNBLOCK);
}

StopSignal::StopSignal() : impl_(std::make_unique<Impl>()) {
    letStopSignalsGo(); // one that came before is caught now
    impl_->signals.async_wait([impl = impl_.get()](boost::system::error_code failure, int signal) {
        impl->caught = failure ? 0 : signal;
        impl->io.stop();
    });
}

StopSignal::~StopSignal() = default;

void StopSignal::onHangup(std::function<void()> action) {
    impl_->on_hangup = std::move(action);
    impl_->hangups.add(SIGHUP);
    impl_->awaitHangup();
}

int StopSignal::wait(std::chrono::milliseconds period, const std::function<bool()>& goes_on) {
    do {
        impl_->io.run_for(period);
    } while (!impl_->io.stopped() && goes_on());
    impl_->signals.clear();
    return impl_->caught;
}

void StopSignal::request() {
    boost::asio::post(impl_->io, [impl = impl_.get()] { impl->signals.cancel(); });
}

} // namespace froxel::net
