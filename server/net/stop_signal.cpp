#include "net/stop_signal.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>

#include <csignal>

namespace froxel::net {

struct StopSignal::Impl {
    boost::asio::io_context io;
    boost::asio::signal_set signals{io, SIGTERM, SIGINT};
    int caught = 0;
};

StopSignal::StopSignal() : impl_(std::make_unique<Impl>()) {
    impl_->signals.async_wait([impl = impl_.get()](boost::system::error_code failure, int signal) {
        impl->caught = failure ? 0 : signal;
    });
}

StopSignal::~StopSignal() = default;

int StopSignal::wait() {
    impl_->io.run();
    impl_->signals.clear();
    return impl_->caught;
}

void StopSignal::request() {
    boost::asio::post(impl_->io, [impl = impl_.get()] { impl->signals.cancel(); });
}

} // namespace froxel::net
