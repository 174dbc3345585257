// How often an account may ask over HTTP. Any thread.
#pragma once

#include "core/allowances.h"
#include "session/account.h"

#include <mutex>

namespace froxel::net {

class RequestLimits {
  public:
    // A page and a gallery of all its pictures, for a class behind one address; and its watching.
    static constexpr double kAtOnce = 1000;
    static constexpr double kPerSecond = 50;
    // Requests that one with a wrong token counts as.
    static constexpr double kWrongToken = 20;

    // 0 s where one more request of the account may be answered, which is counted then; else how
    // long it has to wait for that.
    [[nodiscard]] Seconds ask(const session::Account& account, TimePoint now);
    void onWrongToken(const session::Account& account, TimePoint now);

  private:
    std::mutex mutex_;
    Allowances<session::Account> allowances_{kAtOnce, kPerSecond};
};

} // namespace froxel::net
