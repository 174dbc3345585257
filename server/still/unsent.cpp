#include "still/unsent.h"

#include <algorithm>
#include <utility>

namespace froxel::still {
namespace {

// A client that reads at all has most of its answers by then.
constexpr Seconds kTimeToRead{2};

} // namespace

SharedBytes Unsent::hold(const SharedBytes& bytes, const std::optional<session::Account>& account) {
    Entries::iterator entry;
    {
        const std::lock_guard lock(mutex_);
        entry = entries_.insert(
            entries_.end(), Entry{account.value_or(session::Account()), uint64_t{bytes->size()}});
        all_ += entry->bytes;
        by_account_[entry->account] += entry->bytes;
    }
    return {bytes.get(), LetGo{shared_from_this(), entry, bytes}};
}

void Unsent::LetGo::operator()(const void* /*bytes*/) const {
    std::function<void()> close; // goes without the lock: it may hold a connection's last part
    const std::lock_guard lock(owner->mutex_);
    close = std::exchange(entry->close, nullptr);
    owner->uncount(*entry);
    owner->entries_.erase(entry);
}

void Unsent::uncount(Entry& entry) {
    const uint64_t bytes = std::exchange(entry.bytes, 0);
    all_ -= bytes;
    const auto own = by_account_.find(entry.account);
    if (own != by_account_.end() && (own->second -= bytes) == 0) {
        by_account_.erase(own);
    }
}

void Unsent::sending(const SharedBytes& held, std::function<void()> close, TimePoint now) {
    if (const LetGo* let_go = std::get_deleter<LetGo>(held)) {
        const std::lock_guard lock(let_go->owner->mutex_);
        let_go->entry->close = std::move(close);
        let_go->entry->sent_since = now;
    }
}

bool Unsent::shrinkTo(uint64_t all_bytes, uint64_t own_bytes, TimePoint now) {
    const std::lock_guard lock(mutex_);
    while (all_ > all_bytes) {
        const auto most =
            std::ranges::max_element(by_account_, {}, [](const auto& own) { return own.second; });
        if (most == by_account_.end() || most->second <= own_bytes) {
            return false;
        }
        const auto oldest = std::ranges::find_if(entries_, [&](const Entry& entry) {
            return entry.account == most->first && entry.bytes > 0 && entry.close &&
                   now - *entry.sent_since >= kTimeToRead;
        });
        if (oldest == entries_.end()) {
            return false;
        }
        uncount(*oldest);
        std::exchange(oldest->close, nullptr)();
    }
    return true;
}

uint64_t Unsent::of(const session::Account& account) const {
    const std::lock_guard lock(mutex_);
    const auto own = by_account_.find(account);
    return own == by_account_.end() ? 0 : own->second;
}

uint64_t Unsent::all() const {
    const std::lock_guard lock(mutex_);
    return all_;
}

} // namespace froxel::still
