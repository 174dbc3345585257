// The connections of one listener, in all and by account. Any thread.
#pragma once

#include "core/clock.h"

#include <boost/asio/ip/address.hpp>

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace froxel::net {

class ConnectionTickets {
    struct Book;

  public:
    // Counts a connection for as long as it is held.
    class Ticket {
      public:
        ~Ticket();
        Ticket(const Ticket&) = delete;
        Ticket& operator=(const Ticket&) = delete;

        // The connection waits for its client from now on, and may have to go for another. `close`
        // is called at most once, on any thread, under a lock, and must not block.
        void waitForClient(std::function<void()> close, TimePoint now);
        // The client has said something.
        void heardClient();

      private:
        friend class ConnectionTickets;
        using Counts = std::map<std::string, uint32_t>; // by account; none has 0
        struct Entry {
            Counts::iterator account; // while it is counted
            std::optional<TimePoint> waits_since{};
            std::function<void()> close{};
            bool counted = true; // until it had to go
        };
        Ticket(std::shared_ptr<Book> book, std::list<Entry>::iterator entry);

        const std::shared_ptr<Book> book_; // tickets may outlive the listener
        const std::list<Entry>::iterator entry_;
    };

    explicit ConnectionTickets(uint32_t connections_max);

    // None where there are so many already, or `account_max` of the peer's account (callerAt), and
    // none that waits for its client gives way: one of the account that has most, if it has more
    // than the peer's, and of these the one that has waited longest; else one of the peer's own,
    // after a second at least.
    [[nodiscard]] std::shared_ptr<Ticket>
    take(const boost::asio::ip::address& peer, uint32_t account_max, TimePoint now);

  private:
    const uint32_t connections_max_;
    const std::shared_ptr<Book> book_;
};

using ConnectionTicket = std::shared_ptr<ConnectionTickets::Ticket>;

} // namespace froxel::net
