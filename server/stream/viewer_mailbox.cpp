#include "stream/viewer_mailbox.h"

#include <algorithm>
#include <utility>

namespace froxel::stream {

void ViewerMailbox::publish(session::SessionId id, Slot& slot) {
    if (!std::exchange(slot.fresh, true)) {
        fresh_.push_back(id);
    }
    wakeUp();
}

void ViewerMailbox::wakeUp() {
    awake_ = true;
    wake_.notify_one();
}

Result<session::SessionId> ViewerMailbox::join(std::weak_ptr<session::FrameSink> sink,
                                               const session::SessionState& state,
                                               std::optional<session::Account> account,
                                               TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (closed_) {
        return *closed_;
    }
    const session::SessionId id = ++last_id_;
    Slot& slot = slots_[id];
    slot.news = {id, std::move(sink), std::move(account), state, now, 0, {}, false};
    publish(id, slot);
    return id;
}

Result<void> ViewerMailbox::check() const {
    const std::lock_guard lock(mutex_);
    return closed_ ? Result<void>(*closed_) : Result<void>();
}

template <class Change>
void ViewerMailbox::change(session::SessionId id, const Change& apply) {
    const std::lock_guard lock(mutex_);
    const auto found = slots_.find(id);
    if (found == slots_.end() || found->second.news.left) {
        return;
    }
    apply(found->second.news);
    publish(id, found->second);
}

void ViewerMailbox::update(session::SessionId id,
                           const session::SessionState& state,
                           TimePoint arrived) {
    change(id, [&](ViewerNews& news) {
        news.state = state;
        news.arrived = arrived;
    });
}

void ViewerMailbox::grant(session::SessionId id, uint64_t frame_total) {
    change(id, [&](ViewerNews& news) { news.granted = frame_total; });
}

void ViewerMailbox::setDelivery(session::SessionId id, const session::Delivery& delivery) {
    change(id, [&](ViewerNews& news) { news.delivery = delivery; });
}

void ViewerMailbox::leave(session::SessionId id) {
    change(id, [](ViewerNews& news) { news.left = true; });
}

void ViewerMailbox::noteProgress(session::SessionId id) {
    const std::lock_guard lock(mutex_);
    if (const auto slot = slots_.find(id); slot != slots_.end()) {
        publish(id, slot->second);
    } else {
        wakeUp();
    }
}

void ViewerMailbox::wake() {
    const std::lock_guard lock(mutex_);
    wakeUp();
}

void ViewerMailbox::close(Error reason) {
    const std::lock_guard lock(mutex_);
    closed_ = std::move(reason);
}

std::vector<ViewerNews> ViewerMailbox::take() {
    std::vector<ViewerNews> all;
    const std::lock_guard lock(mutex_);
    all.reserve(fresh_.size());
    for (const session::SessionId id : fresh_) {
        const auto slot = slots_.find(id);
        ViewerNews& news = slot->second.news;
        slot->second.fresh = false;
        all.push_back({id, std::move(news.sink), std::exchange(news.account, std::nullopt),
                       std::exchange(news.state, std::nullopt), news.arrived, news.granted,
                       news.delivery, news.left});
        if (news.left) {
            slots_.erase(slot);
        }
    }
    fresh_.clear();
    return all;
}

bool ViewerMailbox::hasNews() const {
    const std::lock_guard lock(mutex_);
    return !fresh_.empty();
}

void ViewerMailbox::wait(const std::stop_token& stop, std::optional<TimePoint> deadline) {
    std::unique_lock lock(mutex_);
    const auto awake = [this] { return awake_; };
    if (deadline) {
        wake_.wait_until(lock, stop, *deadline, awake);
    } else {
        wake_.wait(lock, stop, awake);
    }
    awake_ = false;
}

} // namespace froxel::stream
