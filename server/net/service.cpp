#include "net/service.h"

#include <algorithm>
#include <utility>

namespace froxel::net {

ServiceStatus Service::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

template <class Change>
void Service::change(const Change& apply) {
    std::vector<std::weak_ptr<ServiceListener>> listeners;
    {
        const std::lock_guard lock(mutex_);
        apply(status_);
        listeners = listeners_;
    }
    for (const auto& weak : listeners) {
        if (const auto listener = weak.lock()) {
            listener->onServiceChanged();
        }
    }
}

void Service::setLoading(Progress progress) {
    change([&](ServiceStatus& status) { status.loading = std::move(progress); });
}

void Service::setServing(Serving serving) {
    change([&](ServiceStatus& status) { status.serving = std::move(serving); });
}

void Service::setDraining(Draining draining) {
    change([&](ServiceStatus& status) { status.draining = std::move(draining); });
}

void Service::setLost(std::string why) {
    change([&](ServiceStatus& status) { status.lost = std::move(why); });
}

void Service::announce() {
    change([](ServiceStatus& /*status*/) {});
}

void Service::subscribe(std::weak_ptr<ServiceListener> listener) {
    const std::lock_guard lock(mutex_);
    // The departed go now, so that the list is never longer than the connections were.
    std::erase_if(listeners_, [](const auto& weak) { return weak.expired(); });
    listeners_.push_back(std::move(listener));
}

} // namespace froxel::net
