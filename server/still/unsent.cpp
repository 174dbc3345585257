#include "still/unsent.h"

namespace froxel::still {

SharedBytes Unsent::hold(const SharedBytes& bytes, const std::optional<session::Account>& account) {
    const uint64_t count = bytes->size();
    {
        const std::lock_guard lock(mutex_);
        all_ += count;
        if (account && count > 0) {
            by_account_[*account] += count;
        }
    }
    return {bytes.get(), [self = shared_from_this(), bytes, count, account](const void*) {
                self->letGo(count, account);
            }};
}

void Unsent::letGo(uint64_t bytes, const std::optional<session::Account>& account) {
    const std::lock_guard lock(mutex_);
    all_ -= bytes;
    const auto own = account ? by_account_.find(*account) : by_account_.end();
    if (own != by_account_.end() && (own->second -= bytes) == 0) {
        by_account_.erase(own);
    }
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
