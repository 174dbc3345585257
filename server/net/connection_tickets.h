// Counts the connections of one listener, in all and by account. Any thread.
#pragma once

#include "net/client_address.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace froxel::net {

// Counts a connection for as long as it is held.
using ConnectionTicket = std::shared_ptr<const void>;

class ConnectionTickets {
  public:
    explicit ConnectionTickets(uint32_t connections_max) : connections_max_(connections_max) {}

    // None where there are so many already, or `account_max` of the peer's account (callerAt).
    [[nodiscard]] ConnectionTicket take(const boost::asio::ip::address& peer,
                                        uint32_t account_max) {
        std::string account = callerAt(peer).address.key;
        {
            const std::lock_guard lock(counts_->mutex);
            if (counts_->total >= connections_max_ || counts_->of(account) >= account_max) {
                return nullptr;
            }
            ++counts_->by_account[account];
            ++counts_->total;
        } // a ticket that memory does not suffice for is dropped, which locks
        return {counts_.get(), [counts = counts_, account = std::move(account)](const void*) {
                    counts->drop(account);
                }};
    }

  private:
    struct Counts { // held by tickets, which may outlive the listener
        [[nodiscard]] uint32_t of(const std::string& account) const {
            const auto found = by_account.find(account);
            return found == by_account.end() ? 0 : found->second;
        }
        void drop(const std::string& account) {
            const std::lock_guard lock(mutex);
            --total;
            const auto found = by_account.find(account);
            if (--found->second == 0) {
                by_account.erase(found);
            }
        }

        std::mutex mutex;
        std::map<std::string, uint32_t> by_account;
        uint32_t total = 0;
    };

    const uint32_t connections_max_;
    const std::shared_ptr<Counts> counts_ = std::make_shared<Counts>();
};

} // namespace froxel::net
