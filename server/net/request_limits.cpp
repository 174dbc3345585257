#include "net/request_limits.h"

namespace froxel::net {

Seconds RequestLimits::ask(const session::Account& account, TimePoint now) {
    const std::lock_guard lock(mutex_);
    Allowance& allowance = allowances_.of(account, now);
    return allowance.take(now) ? Seconds(0) : Seconds(allowance.nextAt(now) - now);
}

void RequestLimits::onWrongToken(const session::Account& account, TimePoint now) {
    const std::lock_guard lock(mutex_);
    allowances_.of(account, now).spend(kWrongToken, now);
}

} // namespace froxel::net
