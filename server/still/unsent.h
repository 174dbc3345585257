// The bytes of answers until their connections have sent them.
#pragma once

#include "core/encoded_frame.h"
#include "session/account.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace froxel::still {

// Any thread.
class Unsent : public std::enable_shared_from_this<Unsent> {
  public:
    // The same bytes, counted until the last holder of what comes back lets go.
    [[nodiscard]] SharedBytes hold(const SharedBytes& bytes,
                                   const std::optional<session::Account>& account);
    // Those of one account.
    [[nodiscard]] uint64_t of(const session::Account& account) const;
    [[nodiscard]] uint64_t all() const;

  private:
    void letGo(uint64_t bytes, const std::optional<session::Account>& account);

    mutable std::mutex mutex_;
    std::map<session::Account, uint64_t> by_account_; // none has 0
    uint64_t all_ = 0;
};

} // namespace froxel::still
