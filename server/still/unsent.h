// The bytes of answers until their connections have sent them.
#pragma once

#include "core/clock.h"
#include "core/encoded_frame.h"
#include "session/account.h"

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace froxel::still {

// Any thread.
class Unsent : public std::enable_shared_from_this<Unsent> {
  public:
    // The same bytes, counted until the last holder of what comes back lets go, or until they have
    // to go.
    [[nodiscard]] SharedBytes hold(const SharedBytes& bytes,
                                   const std::optional<session::Account>& account);
    // What hold() gave is on its way to a client from now on, and may have to go for others'.
    // `close` is called at most once, on any thread, under a lock, and must not block: it has the
    // bytes let go soon.
    static void sending(const SharedBytes& held, std::function<void()> close, TimePoint now);
    // Has answers go until there are at most so many bytes in all: the oldest of whoever has most,
    // if that is more than `own_bytes`, and if their clients have had some time to read them.
    // Whether there are.
    [[nodiscard]] bool shrinkTo(uint64_t all_bytes, uint64_t own_bytes, TimePoint now);
    // Those of one account.
    [[nodiscard]] uint64_t of(const session::Account& account) const;
    [[nodiscard]] uint64_t all() const;

  private:
    using Counts = std::map<session::Account, uint64_t>; // none has 0
    struct Entry {
        session::Account account; // no name: none
        uint64_t bytes = 0;       // 0: it had to go
        std::optional<TimePoint> sent_since{};
        std::function<void()> close{};
    };
    using Entries = std::list<Entry>; // oldest first
    struct LetGo {
        void operator()(const void* /*bytes*/) const;
        std::shared_ptr<Unsent> owner;
        Entries::iterator entry;
        SharedBytes bytes;
    };

    void uncount(Entry& entry);

    mutable std::mutex mutex_;
    Entries entries_;
    Counts by_account_;
    uint64_t all_ = 0;
};

} // namespace froxel::still
